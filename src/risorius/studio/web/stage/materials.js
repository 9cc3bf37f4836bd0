/**
 * How the head's pieces are shaded: plain diffuse light, which software draws fast enough, with what makes a face
 * look alive added: light that goes round the edges of shadow in skin, its gloss, shade that the head at rest
 * keeps from itself, a dark mouth, eyes that mirror the room.
 */

import * as THREE from "../vendor/three/three.module.min.js";

const HAIRS = ["brows", "lashes", "hair"];
const MOUTH = ["teeth", "tongue"];

/**
 * @param {string} name of the piece's material in the head's file
 * @param {{iris: THREE.Texture, mirrored: THREE.Texture, cloth: number[]}} pictures and the linear colour of cloth
 * @returns {THREE.Material}
 */
export function materialOf(name, pictures) {
  if (name === "eye") return eyeMaterial(pictures);
  const side = HAIRS.includes(name) ? THREE.DoubleSide : THREE.FrontSide;
  const material = new THREE.MeshLambertMaterial({ vertexColors: true, side });
  if (name === "skin") clothed(material, pictures.cloth);
  if (MOUTH.includes(name)) hidden(material);
  if (HAIRS.includes(name)) patch(material, HAIR);
  return material;
}

/** Put other text in place of parts of three.js's shaders: {vertex: [[from, to], …], fragment: […]}. */
function patch(material, { vertex = [], fragment = [] }, uniforms = {}) {
  // three.js tells shaders apart by the text of onBeforeCompile, which is the same for all of these.
  material.customProgramCacheKey = () => JSON.stringify([vertex, fragment]);
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    for (const [from, to] of vertex) shader.vertexShader = shader.vertexShader.replace(from, to);
    for (const [from, to] of fragment) shader.fragmentShader = shader.fragmentShader.replace(from, to);
  };
}

// Light goes round the edge of shadow in skin, red farthest: widths of that edge, by colour.
const WRAP = "vec3( 0.30, 0.13, 0.08 )";

const SKIN_LIT = THREE.ShaderChunk.lights_lambert_pars_fragment.replace(
  "vec3 irradiance = dotNL * directLight.color;",
  `float facing = dot( geometryNormal, directLight.direction );
  vec3 wrapped = saturate( ( vec3( facing ) + ${WRAP} ) / ( 1.0 + ${WRAP} ) );
  vec3 irradiance = wrapped * directLight.color;
  vec3 between = normalize( directLight.direction + geometryViewDir );
  float shine = max( dot( geometryNormal, between ), 0.0 );
  float grazing = 1.0 - max( dot( geometryViewDir, between ), 0.0 );
  float gloss = pow( shine, 14.0 ) * ( 0.028 + 0.30 * pow( grazing, 4.0 ) );
  reflectedLight.directSpecular += gloss * dotNL * directLight.color * RECIPROCAL_PI * 3.0;`,
);

const REACHED = THREE.ShaderChunk.lights_fragment_begin.replace(
  "getDirectionalLightInfo( directionalLight, directLight );",
  "getDirectionalLightInfo( directionalLight, directLight );\n\t\tdirectLight.color *= lampReach[ i ];",
);

/** The skin ends at the neckline, within a triangle too: the file's colours go over into the cloth's. */
function clothed(material, cloth) {
  material.userData.hemmed = { value: 0 };
  const uniforms = { hemmed: material.userData.hemmed, cloth: { value: new THREE.Color(...cloth) } };
  patch(material, SKIN, uniforms);
}

const CARRIED = `#include <common>
varying float roomFree;
varying vec4 lampReach;
varying vec2 worn; // mm into the cloth, and the share that the colour has of it
`;
const WORN_OVER = "10.0"; // mm over which the file's colours go from skin to cloth

// What is left of the colour without the cloth's share is the skin's; skin is shaded where the collar begins.
const CUT = `#include <color_fragment>
  float width = clamp( fwidth( worn.x ), 0.15, 3.0 );
  float covered = smoothstep( - width, width, worn.x );
  vec3 bare = max( ( vColor.rgb - worn.y * cloth ) / max( 1.0 - worn.y, 0.1 ), vec3( 0.0 ) );
  bare *= 1.0 - 0.4 * exp( min( worn.x, 0.0 ) / 2.5 );
  float seam = worn.x - 9.0;
  vec3 knit = cloth * ( 1.0 - 0.3 * exp( - seam * seam * 0.6 ) );
  if ( hemmed > 0.5 && worn.x > - 30.0 ) diffuseColor.rgb = mix( bare, knit, covered );
`;

const SKIN = {
  vertex: [
    ["#include <common>", `attribute float free;\nattribute vec4 reach;\nattribute float hem;\n${CARRIED}`],
    [
      "#include <begin_vertex>",
      `#include <begin_vertex>
      roomFree = free;
      lampReach = reach;
      worn = vec2( hem, clamp( 0.5 + hem / ${WORN_OVER}, 0.0, 1.0 ) );`,
    ],
  ],
  fragment: [
    ["#include <common>", `uniform float hemmed;\nuniform vec3 cloth;\n${CARRIED}`],
    ["#include <color_fragment>", CUT],
    ["#include <lights_lambert_pars_fragment>", SKIN_LIT],
    ["#include <lights_fragment_begin>", REACHED],
    ["#include <lights_fragment_end>", "irradiance *= roomFree;\n#include <lights_fragment_end>"],
  ],
};

// Hair is lit from both sides of a strand, and shines along its length where the light grazes it.
const HAIR = {
  fragment: [
    [
      "#include <lights_lambert_pars_fragment>",
      THREE.ShaderChunk.lights_lambert_pars_fragment.replace(
        "float dotNL = saturate( dot( geometryNormal, directLight.direction ) );",
        "float dotNL = saturate( 0.12 + 0.72 * dot( geometryNormal, directLight.direction ) );",
      ),
    ],
  ],
};

/** Darken what stands back in the mouth, between `mouth.x` and `mouth.y` mm, and all where `lit` is 0: shut lips. */
function hidden(material) {
  const { userData } = material;
  userData.mouth = { value: new THREE.Vector2() };
  userData.lit = { value: 1 };
  patch(material, MOUTH_DIM, { mouth: userData.mouth, lit: userData.lit });
}

const MOUTH_DIM = {
  vertex: [
    ["#include <common>", "#include <common>\nvarying float depth;"],
    ["#include <begin_vertex>", "#include <begin_vertex>\ndepth = position.z;"],
  ],
  fragment: [
    ["#include <common>", "#include <common>\nvarying float depth;\nuniform vec2 mouth;\nuniform float lit;"],
    [
      "#include <color_fragment>",
      "#include <color_fragment>\ndiffuseColor.rgb *= mix( 0.05, 0.62, smoothstep( mouth.x, mouth.y, depth ) ) * mix( 0.06, 1.0, lit );",
    ],
  ],
};

function eyeMaterial({ iris, mirrored }) {
  const material = new THREE.MeshStandardMaterial({ map: iris, roughness: 0.06, envMap: mirrored });
  material.envMapIntensity = 0.8;
  patch(material, EYE);
  return material;
}

// The lids shade the ball from above and towards its rim; the cornea is bent more than the ball, so that windows
// are mirrored within the iris. `above` is in the head's frame, `rim` 0..1 from the eye's axis.
const EYE = {
  vertex: [
    ["#include <common>", "#include <common>\nvarying float above;\nvarying vec3 cornea;"],
    [
      "#include <begin_vertex>",
      `#include <begin_vertex>
      above = normalize( mat3( modelMatrix ) * position ).y;
      vec2 bent = 1.5 * position.xy / length( position );
      cornea = normalMatrix * vec3( bent, sqrt( max( 1.0 - dot( bent, bent ), 0.02 ) ) );`,
    ],
  ],
  fragment: [
    ["#include <common>", "#include <common>\nvarying float above;\nvarying vec3 cornea;"],
    [
      "#include <map_fragment>",
      `#include <map_fragment>
      float rim = length( vMapUv - 0.5 ) * 2.0;
      diffuseColor.rgb *= mix( vec3( 0.74 ), vec3( 0.42, 0.33, 0.30 ), smoothstep( 0.42, 0.9, rim ) );
      diffuseColor.rgb *= 1.0 - 0.55 * smoothstep( 0.12, 0.42, above );`,
    ],
    [
      "#include <normal_fragment_begin>",
      `#include <normal_fragment_begin>
      normal = normalize( mix( normal, normalize( cornea ), 1.0 - smoothstep( 0.40, 0.54, rim ) ) );`,
    ],
  ],
};
