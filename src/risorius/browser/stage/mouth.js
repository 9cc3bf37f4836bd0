/** Teeth, gums and tongue as the library's renderer draws them (`render/materials/mouth.py`): wet, in the light that passes the lips. */

import * as THREE from "../vendor/three/three.module.min.js";
import { MM } from "./geometry.js";
import { lighting } from "./shading.js";
import { DEVELOPED } from "./tone.js";
/** @import {StageTable} from "../wire.js" */

const CARRIED = "varying vec3 tinted;\nvarying vec3 place;\nvarying vec3 facing;\n";
const QUICK = "varying vec3 shown;\n";

const PLACED = `
  vec4 world = modelMatrix * vec4( position, 1.0 );
  vec3 there = world.xyz * ${MM.toFixed(1)}, normals = mat3( modelMatrix ) * normal;
  gl_Position = projectionMatrix * viewMatrix * world;`;

const VERTEX = `
${CARRIED}
void main() {
  ${PLACED}
  tinted = color;
  place = there;
  facing = normals;
}`;

const TEETH = {
  spread: "albedo *= lib_reddened( deep = lib_spread_in_teeth( deep ) );",
  lamp: "light += albedo * lampColours[ k ] * lib_tooth_share( dot( normal, lampWays[ k ] ) ) * arriving;",
  entering: "",
  gloss: ["TOOTH_ROUGHNESS", "TOOTH_STRENGTH"],
};
const TONGUE = {
  spread: "deep = lib_spread_in_flesh( deep );",
  lamp: "",
  entering: "light += albedo * enteringLight() * lib_towards_lips( dot( normal, headTurn[ 2 ] ) ) * deep * past.y;",
  gloss: ["TONGUE_ROUGHNESS", "TONGUE_STRENGTH"],
};

/** @param {StageTable} packing @param {typeof TEETH} kind */
const lit = (packing, { spread, lamp, entering, gloss: [roughness, strength] }) => `
#include <common>
${lighting(packing)}
vec3 litMouth( vec3 albedo, vec3 place, vec3 normal, float key ) {
  vec3 view = towards( place );
  vec2 past = pastLips( place );
  float deep = past.x;
  ${spread}
  vec3 light = albedo * lib_ambient_on( ambient, normal, 1.0 ) * AROUND * deep;
  ${entering}
  for ( int k = 0; k < int( FRONT ); k ++ ) {
    float arriving = deep * ( k == 0 ? key : 1.0 );
    ${lamp}
    light += lampColours[ k ] * lib_gloss( normal, view, lampWays[ k ], ${roughness}, WET_GLOSS ) * ${strength} * arriving;
  }
  return light;
}
`;

const PIXEL = `
${CARRIED}
void main() {
  gl_FragColor = vec4( litMouth( tinted, place, normalize( facing ), keyShare( place ) ), 1.0 );
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
}`;

// In motion and without a graphics card: lit at the vertices, since such a machine also shades the pixels that lips hide.
const QUICK_VERTEX = `
${QUICK}
void main() {
  ${PLACED}
  shown = developed( litMouth( color, there, normalize( normals ), keyShare( there, 0, 2 ) ) );
}`;

const QUICK_PIXEL = `
${QUICK}
void main() {
  gl_FragColor = vec4( shown, 1.0 );
}`;

/**
 * @param {StageTable} packing @param {Record<string, {value: any}>} uniforms those that `lighting` reads
 * @param {string} name of the piece's material in the head's file
 * @returns {THREE.ShaderMaterial} whose `userData.quick` is the material for motion
 */
export function mouthMaterial(packing, uniforms, name) {
  const light = lit(packing, name === "tongue" ? TONGUE : TEETH);
  const shared = { uniforms, vertexColors: true };
  const material = new THREE.ShaderMaterial({ ...shared, vertexShader: VERTEX, fragmentShader: light + PIXEL });
  material.userData.quick = new THREE.ShaderMaterial({
    ...shared,
    vertexShader: DEVELOPED + light + QUICK_VERTEX,
    fragmentShader: QUICK_PIXEL,
    toneMapped: false,
  });
  return material;
}
