/**
 * Hairs as the library's renderer draws them (`render/materials/hair.py`): ribbons that face the camera, lit
 * at their vertices, since many overlap in each pixel.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { MM } from "./geometry.js";
import { lighting } from "./shading.js";
import { DEVELOPED } from "./tone.js";
/** @import {StageTable} from "../wire.js" */

export const HAIRS = ["brows", "lashes", "hair", "hairline"];

const LEAST = "0.25"; // pixels: half the breadth of the thinnest hair
const CARRIED = "varying vec3 grown;\nvarying float aside;\nvarying float soft;\n";

// Many hairs overlap in each pixel: a few texels of the shadow are enough for each, and one texel in motion.
// Hairs thinner than half a pixel (one of the library's samples) would glitter: enough of them are left out, and the others widened,
// to cover the same area (`render/ribbons.py`). Edges are soft over one pixel.
/** @param {StageTable} packing @param {string} key the share of the key lamp */
const vertex = (packing, key) => `
#include <common>
${DEVELOPED}
${lighting(packing)}
${CARRIED}
attribute vec2 breadth; // mm: half of it, and half of that below which the hair is left out
attribute vec3 along;
attribute vec4 shaded; // the share of light that comes between other hairs, the strength of the highlights
uniform float pixels;
uniform float millimetres; // to a pixel
void main() {
  vec4 midst = modelMatrix * vec4( position, 1.0 );
  if ( breadth.y < ${LEAST} * millimetres ) {
    gl_Position = vec4( 2.0, 2.0, 2.0, 1.0 );
    return;
  }
  vec3 place = midst.xyz * ${MM.toFixed(1)}, view = towards( place ), fibre = normalize( mat3( modelMatrix ) * along );
  vec3 side = lib_facing_fibre( fibre, view );
  float key = ${key}, free = shaded.x;
  vec3 light = color * lib_ambient_on( ambient, side, free );
  for ( int k = 0; k < ${packing.light.lamps.length}; k ++ ) {
    float share = ( k == 0 ? key : 1.0 ) * lib_between_fibres( free );
    light += lib_lamp_on_fibre( color, lampColours[ k ], lampWays[ k ], fibre, side, view, share, shaded.y );
  }
  grown = developed( light );
  vec3 seen = ( viewMatrix * midst ).xyz;
  float away = max( - seen.z, 0.001 );
  soft = max( breadth.x * pixels / ( ${MM.toFixed(1)} * away ), ${LEAST} ) + 0.5;
  aside = ( gl_VertexID & 1 ) == 0 ? 1.0 : - 1.0;
  vec3 breadth = cross( mat3( viewMatrix ) * fibre, seen );
  seen += breadth * aside * soft * away / ( pixels * max( length( breadth ), 1e-6 ) );
  gl_Position = projectionMatrix * vec4( seen, 1.0 );
}`;

const PIXEL = `
${CARRIED}
void main() {
  gl_FragColor = vec4( grown, clamp( ( 1.0 - abs( aside ) ) * soft, 0.0, 1.0 ) );
}`;

/**
 * @param {StageTable} packing @param {Record<string, {value: any}>} light what `lighting` reads
 * @returns {THREE.ShaderMaterial} whose uniforms are shared with `userData.quick`, the material for motion; `pixels` is how
 *   many of the picture's pixels a length has at the same distance, `millimetres` how many a pixel has
 */
export function hairMaterial(packing, light) {
  /** @type {THREE.ShaderMaterialParameters} */
  const shared = {
    uniforms: { ...light, pixels: { value: 1 }, millimetres: { value: 0.3 } },
    fragmentShader: PIXEL,
    vertexColors: true,
    toneMapped: false,
    side: THREE.DoubleSide,
    transparent: true,
    depthWrite: false,
    forceSinglePass: true,
  };
  const material = new THREE.ShaderMaterial({ ...shared, vertexShader: vertex(packing, "keyShare( place, 1, 2 )") });
  material.userData.quick = new THREE.ShaderMaterial({ ...shared, vertexShader: vertex(packing, "keyShare( place, 0, 2 )") });
  return material;
}
