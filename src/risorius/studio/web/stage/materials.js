/**
 * How the head's pieces but skin and eyes are shaded: plain diffuse light, which software draws fast enough, and a dark
 * mouth.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { HAIRS, hairMaterial } from "./hair.js";
import { patch } from "./patch.js";

const MOUTH = ["teeth", "tongue"];

/**
 * @param {string} name of the piece's material in the head's file
 * @returns {THREE.Material}
 */
export function materialOf(name) {
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
