/** Skin, and the cloth below the neckline. */

import * as THREE from "../vendor/three/three.module.min.js";
import { patch } from "./patch.js";
import { quickened } from "./quick.js";
/** @import {StageBlood} from "../wire.js" */

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
  float shine4 = shine * shine * shine * shine;
  float grazing2 = grazing * grazing;
  float gloss = shine4 * shine4 * shine4 * shine * shine * ( 0.028 + 0.30 * grazing2 * grazing2 );
  reflectedLight.directSpecular += gloss * dotNL * directLight.color * RECIPROCAL_PI * 3.0;`,
);

const REACHED = THREE.ShaderChunk.lights_fragment_begin.replace(
  "getDirectionalLightInfo( directionalLight, directLight );",
  "getDirectionalLightInfo( directionalLight, directLight );\n\t\tdirectLight.color *= lampReach[ i ];",
);

const CARRIED = `#include <common>
uniform vec3 cloth;
uniform vec3 neck;
varying float roomFree;
varying vec4 lampReach;
varying vec2 worn; // mm into the cloth, and the share that the colour has of it
varying vec3 perfused;
`;
// Nearly exp( - 2 half_ ): how much of each colour the blood leaves that a place gains.
const BLOOD = `
attribute float gained;
attribute float lipsShare;
uniform vec3 skinAbsorbs;
uniform vec3 lipsAbsorb;
uniform float lipsGain;
`;
const WORN_OVER = "10.0"; // mm over which the file's colours go from skin to cloth

// Where the colour has the cloth's in it, skin is of the neck's.
const BARE = "vec3 bare = mix( vColor.rgb * perfused, neck, smoothstep( 0.0, 0.35, worn.y ) );";

// The skin ends at the neckline, within a triangle too: the file's colours go over into the cloth's. It is shaded
// where the collar begins.
const CUT = `
  float width = clamp( fwidth( worn.x ), 0.15, 3.0 );
  float covered = smoothstep( - width, width, worn.x );
  float collar = 1.0 - 0.4 * exp( min( worn.x, 0.0 ) / 2.5 );
  float seam = worn.x - 9.0;
  float knit = 1.0 - 0.3 * exp( - seam * seam * 0.6 );`;

/** @type {{vertex: any, fragment: any, light: any}} shader text in place of three's */
const SKIN = {
  vertex: [
    ["#include <common>", `attribute float free;\nattribute vec4 reach;\nattribute float hem;\n${BLOOD}${CARRIED}`],
    [
      "#include <begin_vertex>",
      `#include <begin_vertex>
      roomFree = free;
      lampReach = reach;
      worn = vec2( hem, clamp( 0.5 + hem / ${WORN_OVER}, 0.0, 1.0 ) );
      vec3 half_ = 0.5 * ( skinAbsorbs * gained + lipsAbsorb * lipsShare * lipsGain );
      perfused = ( 1.0 - half_ ) / ( 1.0 + half_ );`,
    ],
  ],
  fragment: [
    ["#include <common>", CARRIED],
    ["#include <color_fragment>", `${BARE}${CUT}\ndiffuseColor.rgb = mix( bare * collar, cloth * knit, covered );`],
    // Cloth does not shine.
    ["vec3 outgoingLight = ", "vec3 outgoingLight = ( 1.0 - covered ) * reflectedLight.directSpecular + "],
  ],
  light: [
    ["#include <lights_lambert_pars_fragment>", SKIN_LIT],
    ["#include <lights_fragment_begin>", REACHED],
    ["#include <lights_fragment_end>", "irradiance *= roomFree;\n#include <lights_fragment_end>"],
  ],
};

const QUICK = {
  made: "varying vec3 skin;\nvarying vec3 dressed;\n",
  develop: `${BARE}\nskin = developed( bare * light + gloss );\ndressed = developed( cloth * light );`,
  pixel: `
varying vec2 worn;
void main() {
  gl_FragColor = vec4( skin, 1.0 );
  if ( worn.x > - 20.0 ) { // mm: above that there is neither cloth nor the collar's shade
    ${CUT}
    gl_FragColor.rgb = mix( skin * sqrt( collar ), dressed * knit, covered );
  }
}`,
};

/**
 * @param {number[]} cloth its linear colour @param {StageBlood} blood what it absorbs
 * @returns {THREE.Material} whose `userData` has the colour of its `neck`, and as `quick` the material for motion;
 *   `lipsGain` is how much blood the lips gain
 */
export function skinMaterial(cloth, blood) {
  const material = new THREE.MeshLambertMaterial({ vertexColors: true });
  const neck = { value: new THREE.Color() };
  const lipsGain = { value: 0 };
  const [skinAbsorbs, lipsAbsorb] = [blood.skin, blood.lips].map((absorbs) => ({ value: new THREE.Vector3(...absorbs) }));
  const uniforms = { neck, cloth: { value: new THREE.Color().fromArray(cloth) }, skinAbsorbs, lipsAbsorb, lipsGain };
  Object.assign(material.userData, { neck, lipsGain });
  patch(material, SKIN, uniforms);
  material.userData.quick = quickened(material, SKIN, QUICK, uniforms);
  return material;
}

