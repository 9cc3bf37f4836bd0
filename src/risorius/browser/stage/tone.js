/** From light to display: the library's film curve (`render/tone.py`), as three.js's custom tone mapping. */

import * as THREE from "../vendor/three/three.module.min.js";

const WHITE = "6.0";
const FILM = `
vec3 CustomToneMapping( vec3 color ) {
  vec3 x = min( color * toneMappingExposure, vec3( ${WHITE} ) );
  vec3 rolled = x * ( 1.0 + x / ( ${WHITE} * ${WHITE} ) ) / ( 1.0 + 0.55 * x );
  rolled = pow( rolled * ( ( 1.0 + 0.55 * ${WHITE} ) / ( ${WHITE} + 1.0 ) ), vec3( 1.18 ) );
  return saturate( 1.30 * rolled / ( 1.0 + 0.30 * rolled ) );
}`;

/** For materials lit at their vertices: colours of the screen. */
export const DEVELOPED = `
#include <tonemapping_pars_fragment>
#include <colorspace_pars_fragment>
vec3 developed( vec3 light ) {
  return sRGBTransferOETF( vec4( CustomToneMapping( light ), 1.0 ) ).rgb;
}
`;

/** @param {THREE.WebGLRenderer} renderer */
export function developAsFilm(renderer) {
  THREE.ShaderChunk.tonemapping_pars_fragment = THREE.ShaderChunk.tonemapping_pars_fragment.replace(
    "vec3 CustomToneMapping( vec3 color ) { return color; }",
    FILM,
  );
  renderer.toneMapping = THREE.CustomToneMapping;
}
