/**
 * How the head's pieces are shaded. With a graphics card physically, with shadows; without one by plain
 * diffuse light and a highlight, which costs a third and looks nearly the same.
 */

import * as THREE from "../vendor/three/three.module.min.js";

// Light goes round the edge of shadow in skin, red farthest: widths of that edge, by colour.
const WRAP = "vec3( 0.36, 0.17, 0.11 )";
const ROUGHNESS = { skin: 0.5, teeth: 0.25, tongue: 0.35, brows: 0.75, lashes: 0.85, hair: 0.6 };
const HAIRS = ["brows", "lashes", "hair"];
const INSIDE = ["teeth", "tongue"];

/**
 * @param {string} name of the piece's material in the head's file
 * @param {{iris: THREE.Texture, surroundings: THREE.Texture}} pictures
 * @param {boolean} simple whether there is no graphics card
 * @returns {THREE.Material}
 */
export function materialOf(name, pictures, simple) {
  if (name === "eye") return eyeMaterial(pictures);
  const side = HAIRS.includes(name) ? THREE.DoubleSide : THREE.FrontSide;
  const material = simple
    ? new THREE.MeshLambertMaterial({ vertexColors: true, side })
    : new THREE.MeshStandardMaterial({ vertexColors: true, side, roughness: ROUGHNESS[name] ?? 0.5 });
  if (name === "skin") softened(material, simple);
  if (INSIDE.includes(name)) hidden(material);
  return material;
}

/** Let light reach round the edges of shadow, as it does through skin. */
function softened(material, simple) {
  const chunk = simple ? "lights_lambert_pars_fragment" : "lights_physical_pars_fragment";
  const lit = simple ? "vec3 irradiance = dotNL * directLight.color;" : "reflectedLight.directDiffuse += irradiance *";
  const text = THREE.ShaderChunk[chunk].replace(lit, simple ? SOFT_AND_SHINY : SOFT);
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(`#include <${chunk}>`, text);
  };
}

const SOFT = `
  vec3 facing = vec3( dot( geometryNormal, directLight.direction ) );
  vec3 wrapped = saturate( ( facing + ${WRAP} ) / ( 1.0 + ${WRAP} ) );
  reflectedLight.directDiffuse += wrapped * directLight.color *`;

const SOFT_AND_SHINY = `
  vec3 facing = vec3( dot( geometryNormal, directLight.direction ) );
  vec3 wrapped = saturate( ( facing + ${WRAP} ) / ( 1.0 + ${WRAP} ) );
  vec3 irradiance = wrapped * directLight.color;
  float shine = max( dot( geometryNormal, normalize( directLight.direction + geometryViewDir ) ), 0.0 );
  float shine2 = shine * shine;
  float shine4 = shine2 * shine2;
  float shine8 = shine4 * shine4;
  reflectedLight.directSpecular += 0.045 * shine8 * shine8 * wrapped * directLight.color;`;

/** Darken what stands back in the mouth, where little light comes: between `mouth.x` and `mouth.y` mm. */
function hidden(material) {
  material.userData.mouth = { value: new THREE.Vector2() };
  material.onBeforeCompile = (shader) => {
    shader.uniforms.mouth = material.userData.mouth;
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying float depth;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\ndepth = position.z;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying float depth;\nuniform vec2 mouth;")
      .replace("#include <color_fragment>", `#include <color_fragment>\n${DIM}`);
  };
}

const DIM = "diffuseColor.rgb *= mix( 0.10, 0.92, smoothstep( mouth.x, mouth.y, depth ) );";

/** The eye mirrors the room, and its rim lies in the shadow of the lids. */
function eyeMaterial({ iris, surroundings }) {
  const material = new THREE.MeshStandardMaterial({ map: iris, roughness: 0.12, envMap: surroundings });
  material.envMapIntensity = 0.55;
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace("#include <map_fragment>", RIMMED);
  };
  return material;
}

const RIMMED = `#include <map_fragment>
  float rim = length( vMapUv - 0.5 ) * 2.0;
  diffuseColor.rgb *= mix( vec3( 1.0 ), vec3( 0.62, 0.50, 0.46 ), smoothstep( 0.45, 0.95, rim ) );`;
