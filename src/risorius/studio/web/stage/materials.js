/** How the head's pieces are shaded: physically based materials, kept light enough for software GL. */

import * as THREE from "../vendor/three/three.module.min.js";

// Light goes round the edge of shadow in skin, red farthest: widths of that edge, by colour.
const SKIN_WRAP = "vec3(0.34, 0.16, 0.10)";
const SHINE = { skin: 0.48, eye: 0.12, teeth: 0.25, tongue: 0.35, brows: 0.75, lashes: 0.8, hair: 0.55 };

/**
 * @param {string} name of the piece's material in the head's file
 * @param {{iris: THREE.Texture, surroundings: THREE.Texture}} pictures
 * @returns {THREE.Material}
 */
export function materialOf(name, pictures) {
  const common = { roughness: SHINE[name] ?? 0.5, metalness: 0 };
  if (name === "eye") {
    return eyeMaterial(pictures);
  }
  const material = new THREE.MeshStandardMaterial({ ...common, vertexColors: true });
  if (name === "skin") soften(material);
  if (name === "hair" || name === "brows" || name === "lashes") {
    material.side = THREE.DoubleSide;
    combed(material);
  }
  if (name === "teeth" || name === "tongue") hidden(material);
  return material;
}

/** Let light reach round the edges of shadow, as it does through skin. */
function soften(material) {
  const chunk = THREE.ShaderChunk.lights_physical_pars_fragment.replace(
    "reflectedLight.directDiffuse += irradiance *",
    `float facing = dot( geometryNormal, directLight.direction );
     vec3 wrapped = saturate( ( vec3( facing ) + ${SKIN_WRAP} ) / ( 1.0 + ${SKIN_WRAP} ) );
     reflectedLight.directDiffuse += wrapped * wrapped * ( 0.35 + 0.65 / ( wrapped + 0.001 ) ) * directLight.color *`,
  );
  patch(material, "lights_physical_pars_fragment", chunk);
}

/** Let hair shine across its strands: their normals are the scalp's, so the highlight is widened only. */
function combed(material) {
  material.roughness = Math.max(material.roughness, 0.55);
}

/** Darken what stands back in the mouth, where little light comes. Places are in metres from the head's pivot. */
function hidden(material) {
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying float depth;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\ndepth = position.z;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying float depth;\nuniform vec2 mouth;")
      .replace(
        "#include <color_fragment>",
        "#include <color_fragment>\ndiffuseColor.rgb *= mix( 0.10, 0.92, smoothstep( mouth.x, mouth.y, depth ) );",
      );
    shader.uniforms.mouth = material.userData.mouth;
  };
  material.userData.mouth = { value: new THREE.Vector2(-1, 0) };
}

function eyeMaterial({ iris, surroundings }) {
  const material = new THREE.MeshStandardMaterial({ map: iris, roughness: SHINE.eye, metalness: 0 });
  material.envMap = surroundings;
  material.envMapIntensity = 0.55;
  // The lids shade the ball towards its rim.
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <map_fragment>",
      `#include <map_fragment>
       float rim = length( vMapUv - 0.5 ) * 2.0;
       diffuseColor.rgb *= mix( vec3( 1.0 ), vec3( 0.62, 0.50, 0.46 ), smoothstep( 0.45, 0.95, rim ) );`,
    );
  };
  return material;
}

function patch(material, chunk, text) {
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(`#include <${chunk}>`, text);
  };
}
