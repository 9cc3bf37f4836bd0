/**
 * How the head's pieces are shaded: plain diffuse light, which software draws fast enough, with what makes a face
 * look alive added: light that goes round the edges of shadow in skin, its gloss, shade that the head at rest
 * keeps from itself, a dark mouth, eyes that mirror their surroundings.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { HAIRS, hairMaterial } from "./hair.js";
import { patch } from "./patch.js";
import { skinMaterial } from "./skin.js";
/** @import {StageBlood} from "../wire.js" */

const MOUTH = ["teeth", "tongue"];

/**
 * @param {string} name of the piece's material in the head's file
 * @param {{iris: THREE.Texture, mirrored: THREE.Texture, cloth: number[], blood: StageBlood}} pictures, the
 *   linear colour of cloth, and what blood absorbs
 * @returns {THREE.Material}
 */
export function materialOf(name, pictures) {
  if (name === "eye") return eyeMaterial(pictures);
  if (name === "skin") return skinMaterial(pictures.cloth, pictures.blood);
  if (HAIRS.includes(name)) return hairMaterial();
  const material = new THREE.MeshLambertMaterial({ vertexColors: true });
  if (MOUTH.includes(name)) hidden(material);
  return material;
}

/**
 * Darken what stands back in the mouth, between `mouth.x` and `mouth.y` mm, and all where `lit` is 0: shut lips.
 * @param {THREE.Material} material
 */
function hidden(material) {
  const { userData } = material;
  userData.mouth = { value: new THREE.Vector2() };
  userData.lit = { value: 1 };
  patch(material, MOUTH_DIM, { mouth: userData.mouth, lit: userData.lit });
}

/** @type {Record<string, any>} shader text in place of three's */
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

/** @param {{iris: THREE.Texture, mirrored: THREE.Texture}} pictures */
function eyeMaterial({ iris, mirrored }) {
  const material = new THREE.MeshStandardMaterial({ map: iris, roughness: 0.06, envMap: mirrored });
  material.envMapIntensity = 0.8;
  patch(material, EYE);
  return material;
}

// The lids shade the ball from above and towards its rim; the cornea is bent more than the ball, so that windows
// are mirrored within the iris. `above` is in the head's frame, `rim` 0..1 from the eye's axis.
/** @type {Record<string, any>} shader text in place of three's */
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
