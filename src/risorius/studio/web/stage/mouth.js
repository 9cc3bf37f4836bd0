/** Teeth, gums and tongue as the library's renderer draws them (`render/materials/mouth.py`): wet, in the light past the lips. */

import * as THREE from "../vendor/three/three.module.min.js";
import { MM } from "./geometry.js";
import { lighting } from "./shading.js";
/** @import {StageTable} from "../wire.js" */

const CARRIED = "varying vec3 tinted;\nvarying vec3 place;\nvarying vec3 facing;\n";

const VERTEX = `
${CARRIED}
void main() {
  vec4 world = modelMatrix * vec4( position, 1.0 );
  tinted = color;
  place = world.xyz * ${MM.toFixed(1)};
  facing = mat3( modelMatrix ) * normal;
  gl_Position = projectionMatrix * viewMatrix * world;
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
const pixel = (packing, { spread, lamp, entering, gloss: [roughness, strength] }) => `
#include <common>
${lighting(packing)}
${CARRIED}
void main() {
  vec3 normal = normalize( facing ), view = towards( place ), albedo = tinted;
  vec2 past = pastLips( place );
  float deep = past.x, shadow = keyShare( place, 1 );
  ${spread}
  vec3 light = albedo * lib_ambient_on( ambient, normal, 1.0 ) * AROUND * deep;
  ${entering}
  for ( int k = 0; k < int( FRONT ); k ++ ) {
    float arriving = deep * ( k == 0 ? shadow : 1.0 );
    ${lamp}
    light += lampColours[ k ] * lib_gloss( normal, view, lampWays[ k ], ${roughness}, WET_GLOSS ) * ${strength} * arriving;
  }
  gl_FragColor = vec4( light, 1.0 );
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
}`;

/**
 * @param {StageTable} packing @param {Record<string, {value: any}>} uniforms what `lighting` reads
 * @param {string} name of the piece's material in the head's file
 */
export function mouthMaterial(packing, uniforms, name) {
  const fragmentShader = pixel(packing, name === "tongue" ? TONGUE : TEETH);
  return new THREE.ShaderMaterial({ uniforms, vertexColors: true, vertexShader: VERTEX, fragmentShader });
}
