/**
 * Eyes as the library's renderer draws them (`render/materials/eye.py`): wet balls with the iris behind a clear cornea,
 * shaded by their lids and by the face's cast shadow.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { MM } from "./geometry.js";
import { lighting } from "./shading.js";
/** @import {StageEye, StageTable} from "../wire.js" */

const CARRIED = "varying vec3 place;\nvarying vec3 outwards;\nvarying float reached; // the share of the key lamp\n";

/** @param {StageTable} packing @param {boolean} quick */
const vertex = (packing, quick) => `
#include <common>
${quick ? lighting(packing) : ""}
${CARRIED}
void main() {
  vec4 world = modelMatrix * vec4( position, 1.0 );
  place = world.xyz * ${MM.toFixed(1)};
  outwards = mat3( modelMatrix ) * position;
  reached = ${quick ? "keyShareQuick( place )" : "1.0"};
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

// In motion and without a graphics card, the key lamp's shadow is looked up at the vertices: such a machine also shades
// the pixels that lids hide.
/** @param {StageTable} packing @param {boolean} quick */
const pixel = (packing, quick) => `
#include <common>
${lighting(packing)}
${CARRIED}
uniform sampler2D iris;
uniform float radius;
uniform float side; // 1 of the left eye, - 1 of the right
uniform mat3 eyeAxes;
uniform vec2 span;
uniform vec2 lids[ ${packing.shading.lids} ]; // heights of the upper and the lower margin from one corner to the other
vec3 irisColour( vec2 at ) {
  float away = length( at );
  vec2 within = at * min( 1.0, 1.0 / max( away, 1e-6 ) ) * IRIS;
  return texture2D( iris, 0.5 + 0.5 * vec2( within.x, - within.y ) ).rgb * lib_pupil_edge( PUPIL, away );
}
void main() {
  vec3 view = towards( place ), outward = normalize( outwards );
  vec3 local = outward * eyeAxes, inHead = radius * ( outward * headTurn );
  float along = clamp( ( inHead.x - span.x ) / ( span.y - span.x ), 0.0, 1.0 ) * ${(packing.shading.lids - 1.001).toFixed(3)};
  vec2 margins = mix( lids[ int( along ) ], lids[ int( along ) + 1 ], fract( along ) );
  float below = max( margins.x - inHead.y, 0.0 ), above = max( inHead.y - margins.y, 0.0 );
  vec2 corners = max( vec2( inHead.x - span.x, span.y - inHead.x ), 0.0 );
  if ( side < 0.0 ) corners = corners.yx;
  float shade = lib_lid_shade( below, above, corners.x, corners.y );
  float shadow = ${quick ? "reached" : "keyShare( place )"} * shade;
  float irisShare = lib_iris_share( local );
  vec3 white = lib_white_of_eye( grain( local * radius, VEINS ).x, above, corners.x, corners.y );
  vec3 facing = normalize( mix( outward, eyeAxes * normalize( vec3( local.xy, local.z - CORNEA ) ), irisShare ) );
  vec2 at = lib_on_iris( local, lib_refracted( facing, view ) * eyeAxes );
  vec3 coloured = irisColour( at );
  vec3 ball = white * lib_ambient_on( ambient, outward, shade ) * WHITE_AROUND;
  vec3 behind = coloured * lib_ambient_on( ambient, eyeAxes[ 2 ], shade ) * IRIS_AROUND;
  float free = lib_mirror_share( below, shade );
  vec3 wet = lib_ambient_on( ambient, facing, 1.0 ) * lib_schlick( dot( facing, view ), WET ) * free;
  vec3 back = reflect( - view, facing );
  for ( int k = 0; k < int( FRONT ); k ++ ) {
    float arriving = k == 0 ? shadow : shade;
    ball += white * lampColours[ k ] * lib_white_share( dot( outward, lampWays[ k ] ) ) * arriving;
    behind += coloured * lampColours[ k ] * lib_gathered( at.x, at.y, lampWays[ k ] * eyeAxes ) * arriving;
    float bright = lib_window( back, lampWays[ k ], k == 0 ? KEY_WINDOW : FILL_WINDOW ) * ( k == 0 ? KEY_BRIGHT : FILL_BRIGHT );
    wet += lampColours[ k ] * bright * free;
  }
  float rim = lib_tear_glint( outward, view, lampWays[ 0 ], above ) * shadow;
  wet += lampColours[ 0 ] * ( rim + lib_caruncle_glint( outward, view, lampWays[ 0 ], corners.x ) * shade );
  gl_FragColor = vec4( mix( ball, behind, irisShare ) + wet, 1.0 );
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
}`;

/**
 * @param {StageTable} packing @param {Record<string, {value: any}>} light uniforms that `lighting` reads
 * @param {THREE.Texture} iris its picture, as wide as the eye @param {number} number 0 left, 1 right
 */
export function eyeMaterial(packing, light, iris, number) {
  const uniforms = {
    ...light,
    iris: { value: iris },
    radius: { value: packing.eyes[number].radius },
    side: { value: 1 - 2 * number },
    eyeAxes: { value: new THREE.Matrix3() },
    span: { value: new THREE.Vector2(-1, 1) },
    lids: { value: Array.from({ length: packing.shading.lids }, () => new THREE.Vector2()) },
  };
  /** @param {boolean} quick */
  const material = (quick) =>
    new THREE.ShaderMaterial({ uniforms, vertexShader: vertex(packing, quick), fragmentShader: pixel(packing, quick) });
  return Object.assign(material(false), { userData: { quick: material(true) } });
}

/**
 * Set the margins of an eye's lids, as directions from the centre of the ball (`render/aperture.py`).
 * @param {THREE.ShaderMaterial} material @param {StageEye} eye @param {Float32Array} points of the skin, before the head turns
 */
export function placeLids({ uniforms }, { centre, radius, lids }, points) {
  /** @param {number} place of a pair's vertex */
  const margin = (place) =>
    lids
      .map((pair) => {
        const way = [0, 1, 2].map((axis) => points[3 * pair[place] + axis] - centre[axis]);
        const scale = radius / Math.hypot(...way);
        return [way[0] * scale, way[1] * scale];
      })
      .sort(([a], [b]) => a - b);
  const [upper, lower] = [margin(0), margin(1)];
  const low = Math.max(upper[0][0], lower[0][0]);
  const high = Math.min(upper[upper.length - 1][0], lower[lower.length - 1][0]);
  uniforms.span.value.set(low, high);
  uniforms.lids.value.forEach((/** @type {THREE.Vector2} */ heights, /** @type {number} */ k) => {
    const x = low + ((high - low) * k) / (uniforms.lids.value.length - 1);
    heights.set(heightAt(upper, x), heightAt(lower, x));
  });
}

/** @param {number[][]} margin points x, y by x @param {number} x */
function heightAt(margin, x) {
  const next = margin.findIndex(([there]) => there > x);
  if (next <= 0) return margin[next === 0 ? 0 : margin.length - 1][1];
  const [[x0, y0], [x1, y1]] = [margin[next - 1], margin[next]];
  return y0 + ((y1 - y0) * (x - x0)) / (x1 - x0);
}

/**
 * Set the rotation of an eye.
 * @param {THREE.ShaderMaterial} material @param {StageEye} eye @param {THREE.Matrix4} turned of the eyeball in the world
 */
export function turnEye({ uniforms }, { axes }, turned) {
  PUPIL.set(axes[0], axes[1], axes[2], axes[3], axes[4], axes[5], axes[6], axes[7], axes[8]);
  uniforms.eyeAxes.value.setFromMatrix4(turned).multiply(PUPIL);
}

const PUPIL = new THREE.Matrix3();
