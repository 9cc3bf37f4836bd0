/** Hairs: ribbons that lie over what is behind them. */

import * as THREE from "../vendor/three/three.module.min.js";
import { patch } from "./patch.js";
import { quickened } from "./quick.js";

export const HAIRS = ["brows", "lashes", "hair", "hairline"];

const SOLID = "strand.y * clamp( ( 1.0 - abs( aside ) ) * strand.x, 0.0, 1.0 )";

// Hair is lit from both sides of a strand, and shines along its length where the light grazes it. A strand's edges
// are a pixel soft; one that is thinner than a pixel is drawn as wide as one, but fainter: else it would glitter.
/** @type {{vertex: any, fragment: any, light: any}} shader text in place of three's */
const HAIR = {
  vertex: [
    [
      "#include <common>",
      "#include <common>\nattribute vec3 across;\nuniform float pixels;\nvarying float aside;\nvarying vec2 strand;",
    ],
    [
      "#include <begin_vertex>",
      `#include <begin_vertex>
      float away = max( - ( modelViewMatrix * vec4( position, 1.0 ) ).z, 0.001 );
      float own = max( length( ( modelViewMatrix * vec4( across, 0.0 ) ).xyz ) * pixels / away, 0.02 );
      float least = max( own, 0.5 );
      transformed += across * ( ( least + 0.5 ) / own - 1.0 );
      strand = vec2( least + 0.5, own / least );
      aside = ( gl_VertexID & 1 ) == 0 ? 1.0 : - 1.0;`,
    ],
  ],
  fragment: [
    ["#include <common>", "#include <common>\nvarying float aside;\nvarying vec2 strand;"],
    [
      "#include <color_fragment>",
      `#include <color_fragment>
      diffuseColor.a *= ${SOLID};`,
    ],
  ],
  light: [
    [
      "#include <lights_lambert_pars_fragment>",
      THREE.ShaderChunk.lights_lambert_pars_fragment.replace(
        "float dotNL = saturate( dot( geometryNormal, directLight.direction ) );",
        "float dotNL = saturate( 0.12 + 0.72 * dot( geometryNormal, directLight.direction ) );",
      ),
    ],
  ],
};

const QUICK = {
  made: "varying vec3 grown;\n",
  develop: "grown = developed( vColor.rgb * light );",
  pixel: `
varying float aside;
varying vec2 strand;
void main() {
  gl_FragColor = vec4( grown, ${SOLID} );
}`,
};

/**
 * @returns {THREE.Material} whose `userData.pixels` is how many of the picture's pixels a length has at the same
 *   distance, with the one for motion as `userData.quick`
 */
export function hairMaterial() {
  const flags = { side: THREE.DoubleSide, transparent: true, depthWrite: false, forceSinglePass: true };
  const material = new THREE.MeshLambertMaterial({ vertexColors: true, ...flags });
  const uniforms = { pixels: { value: 1 } };
  material.userData.pixels = uniforms.pixels;
  patch(material, HAIR, uniforms);
  material.userData.quick = quickened(material, HAIR, QUICK, uniforms);
  return material;
}
