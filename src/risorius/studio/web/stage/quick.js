/**
 * What a mesh that moves is shaded with where no graphics card draws: the light is that of the material at rest, but
 * worked out at the vertices, of which there are few then. A pixel costs little more than to be filled.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { replaced } from "./patch.js";

export const DEVELOPED = `
#include <tonemapping_pars_fragment>
#include <colorspace_pars_fragment>
vec3 developed( vec3 light ) {
  return sRGBTransferOETF( vec4( CustomToneMapping( light ), 1.0 ) ).rgb;
}
`;

// Light and gloss of a white surface.
const LIT = `
  ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
  {
    vec3 normal = normalize( transformedNormal );
    #ifdef DOUBLE_SIDED
      if ( dot( normal, vViewPosition ) < 0.0 ) normal = - normal;
    #endif
    LambertMaterial material;
    material.diffuseColor = vec3( 1.0 );
    #include <lights_fragment_begin>
    #include <lights_fragment_end>
  }
  vec3 light = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
  vec3 gloss = reflectedLight.directSpecular;
`;

/**
 * @param {THREE.Material} full what the mesh at rest is shaded with; their `userData` is the same
 * @param {{vertex: [string, string][], light: [string, string][]}} parts of its shaders that are its own
 * @param {{made: string, develop: string, pixel: string}} quick the colours that come from the vertex, as both
 *   shaders declare them; what makes these of `light` and `gloss`; the rest of the pixel's shader
 * @param {Record<string, {value: any}>} uniforms
 */
export function quickened(full, { vertex, light }, { made, develop, pixel }, uniforms) {
  const { side, transparent, depthWrite, forceSinglePass, userData } = full;
  const flags = { side, transparent, depthWrite, forceSinglePass };
  const material = new THREE.MeshLambertMaterial({ vertexColors: true, ...flags });
  material.userData = userData;
  material.customProgramCacheKey = () => develop + pixel;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    const model = replaced("#include <lights_lambert_pars_fragment>", light);
    // The vertex shader has this one already.
    const lamps = `#include <lights_pars_begin>\n${model.replace("varying vec3 vViewPosition;", "")}`;
    shader.vertexShader = replaced(shader.vertexShader, [
      ...vertex,
      ["void main() {", `${made}${DEVELOPED}${lamps}\nvoid main() {`],
      ["#include <fog_vertex>", `${replaced(LIT, light)}\n${develop}`],
    ]);
    shader.fragmentShader = made + pixel;
  };
  return material;
}
