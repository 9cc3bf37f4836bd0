/** Hairs: ribbons that lie over what is behind them. */

import * as THREE from "../vendor/three/three.module.min.js";
import { quickened } from "./quick.js";

export const HAIRS = ["brows", "lashes", "hair", "hairline"];

const SOLID = "strand.y * clamp( ( 1.0 - abs( aside ) ) * strand.x, 0.0, 1.0 )";

// A strand turns its breadth to who looks. Its edges are a pixel soft; one that is thinner than a pixel is drawn as wide as
// one, but fainter: else it would glitter. It mirrors light into a cone about its own direction (Kajiya and Kay 1989),
// twice, as `render/materials/hair.py` says it.
const FIBRE = `
  float along = dot( fibre, directLight.direction );
  vec3 across = normalize( geometryViewDir - fibre * dot( fibre, geometryViewDir ) );
  float facing = saturate( 0.6 * dot( across, directLight.direction ) + 0.4 );
  float tilt = dot( fibre, normalize( geometryViewDir + directLight.direction ) );
  float white = 0.085 * exp( - 60.0 * ( tilt + 0.09 ) * ( tilt + 0.09 ) );
  float tinted = 1.9 * exp( - 14.0 * ( tilt - 0.14 ) * ( tilt - 0.14 ) );
  float share = facing * ( 0.4 + 0.6 * lit.x );
  vec3 irradiance = share * ( 0.7 * sqrt( saturate( 1.0 - along * along ) ) + lit.y * tinted ) * directLight.color;
  reflectedLight.directSpecular += share * lit.y * white * RECIPROCAL_PI * directLight.color;`;

const GROWN = "varying vec3 fibre;\nvarying vec2 lit; // the share of light that comes between other hairs, and the strength of the highlights";

/** @type {{vertex: any, light: any}} shader text in place of three's */
const HAIR = {
  vertex: [
    [
      "#include <common>",
      `#include <common>
attribute vec3 across;
attribute vec3 along;
attribute vec4 shaded;
uniform float pixels;
varying float aside;
varying vec2 strand;
${GROWN}`,
    ],
    [
      "#include <begin_vertex>",
      `#include <begin_vertex>
      vec3 midst = ( modelViewMatrix * vec4( position - across, 1.0 ) ).xyz;
      float away = max( - midst.z, 0.001 );
      float own = max( length( mat3( modelViewMatrix ) * across ) * pixels / away, 0.02 );
      float least = max( own, 0.5 );
      strand = vec2( least + 0.5, own / least );
      aside = ( gl_VertexID & 1 ) == 0 ? 1.0 : - 1.0;
      lit = shaded.xy;
      fibre = normalize( mat3( modelViewMatrix ) * along );
      vec3 breadth = cross( fibre, midst );
      breadth *= aside * ( least + 0.5 ) * away / ( pixels * max( length( breadth ), 1e-6 ) );
      transformedNormal = - midst + fibre * dot( fibre, midst );
      vNormal = normalize( transformedNormal );`,
    ],
    ["#include <project_vertex>", "vec4 mvPosition = vec4( midst + breadth, 1.0 );\ngl_Position = projectionMatrix * mvPosition;"],
  ],
  light: [
    [
      "#include <lights_lambert_pars_fragment>",
      THREE.ShaderChunk.lights_lambert_pars_fragment
        .replace("float dotNL = saturate( dot( geometryNormal, directLight.direction ) );", "")
        .replace("vec3 irradiance = dotNL * directLight.color;", FIBRE),
    ],
    ["#include <lights_fragment_end>", "irradiance *= lit.x;\n#include <lights_fragment_end>"],
  ],
};

const QUICK = {
  made: "varying vec3 grown;\n",
  develop: "grown = developed( vColor.rgb * light + gloss );",
  pixel: `
varying float aside;
varying vec2 strand;
void main() {
  gl_FragColor = vec4( grown, ${SOLID} );
}`,
};

/**
 * Hairs are lit at their vertices, at rest too, as in the library's own pictures: many lie over each pixel.
 * @returns {THREE.Material} whose `userData.pixels` is how many of the picture's pixels a length has at the same distance
 */
export function hairMaterial() {
  const flags = { side: THREE.DoubleSide, transparent: true, depthWrite: false, forceSinglePass: true };
  const plain = new THREE.MeshLambertMaterial({ vertexColors: true, ...flags });
  const uniforms = { pixels: { value: 1 } };
  plain.userData.pixels = uniforms.pixels;
  return quickened(plain, HAIR, QUICK, uniforms);
}
