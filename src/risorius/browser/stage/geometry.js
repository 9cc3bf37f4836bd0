/** Make the drawn parts of a head from the server's data: meshes, light and neckline at each vertex, the iris. */

import * as THREE from "../vendor/three/three.module.min.js";
/** @import {FileMesh} from "../types.js" */

export const MM = 1000;
export const LAMPS = 4;
const NAMES = { POSITION: "position", NORMAL: "normal", TEXCOORD_0: "uv", COLOR_0: "color", _LIGHT: "shaded" };
const HEM_STEPS = 4; // a millimetre
const BLOOD_STEPS = 127;
const BYTES = 1 + LAMPS + 1 + 3 + 4; // of a vertex
const ABOVE = [-20, -6]; // mm into the cloth where the neck's colour is taken

/**
 * Return for each vertex of the skin: visibility of each lamp; of the surroundings, with roughness, gloss and
 * curvature; distance to the neckline in mm, with the share of mouth interior.
 * @param {Uint8Array} seen (count, BYTES) as `head_shade.py` packs it
 * @param {number} count of the vertices
 * @returns {{reach: THREE.BufferAttribute, surface: THREE.BufferAttribute, worn: THREE.BufferAttribute}}
 */
export function lightOf(seen, count) {
  const [reach, surface] = [new Uint8Array(LAMPS * count), new Uint8Array(4 * count)];
  const worn = new Float32Array(2 * count);
  for (let vertex = 0; vertex < count; vertex++) {
    const own = seen.subarray(vertex * BYTES, (vertex + 1) * BYTES);
    reach.set(own.subarray(1, 1 + LAMPS), LAMPS * vertex);
    surface.set([own[0], ...own.subarray(BYTES - 4, BYTES - 1)], 4 * vertex);
    worn.set([(own[1 + LAMPS] - 128) / HEM_STEPS, own[BYTES - 1] / 255], 2 * vertex);
  }
  return {
    reach: new THREE.BufferAttribute(reach, LAMPS, true),
    surface: new THREE.BufferAttribute(surface, 4, true),
    worn: new THREE.BufferAttribute(worn, 2),
  };
}

/**
 * Return the visibility of blood at each vertex of the skin.
 * @param {Uint8Array} seen as for `lightOf` @param {number} count of the vertices
 */
export function bloodOf(seen, count) {
  /** @param {number} place among a vertex' bytes @param {number} none */
  const column = (place, none) =>
    Float32Array.from({ length: count }, (_, vertex) => (seen[vertex * BYTES + place] - none) / BLOOD_STEPS);
  return { flesh: column(LAMPS + 2, 0), lips: column(LAMPS + 3, 0), folded: column(LAMPS + 4, 128) };
}

/** Return the mean colour of the skin just above the cloth. @param {Record<string, THREE.BufferAttribute>} attributes */
export function neckColour({ color, worn }) {
  const [sum, one] = [new THREE.Color(0, 0, 0), new THREE.Color()];
  let count = 0;
  for (let vertex = 0; vertex < worn.count; vertex++) {
    if (worn.getX(vertex) < ABOVE[0] || worn.getX(vertex) > ABOVE[1]) continue;
    sum.add(one.setRGB(color.getX(vertex), color.getY(vertex), color.getZ(vertex)));
    count += 1;
  }
  return sum.multiplyScalar(1 / Math.max(count, 1));
}

/**
 * Return the share by which each vertex turns with the head: its weight for the second joint, the head's.
 * @param {FileMesh} mesh
 */
export function neckShare({ attributes }) {
  const { array } = attributes.WEIGHTS_0;
  return Float32Array.from({ length: array.length / 4 }, (_, vertex) => array[4 * vertex + 1] / 255);
}

/**
 * Return a mesh of the file in mm; `moves` marks one whose points and normals change often.
 * @param {FileMesh} data @param {boolean} moves
 */
export function geometryOf(data, moves) {
  const geometry = new THREE.BufferGeometry();
  for (const [theirs, ours] of Object.entries(NAMES)) {
    const found = data.attributes[theirs];
    if (!found) continue;
    const array = found.array.slice();
    if (ours === "position") for (let k = 0; k < array.length; k++) array[k] *= MM;
    const attribute = new THREE.BufferAttribute(array, found.width, found.normalized);
    if (moves && (ours === "position" || ours === "normal")) attribute.setUsage(THREE.DynamicDrawUsage);
    geometry.setAttribute(ours, attribute);
  }
  return geometry.setIndex(new THREE.BufferAttribute(data.index, 1));
}

/** @param {Blob} blob a picture of the iris @returns {Promise<THREE.Texture>} */
export async function irisTexture(blob) {
  const texture = new THREE.Texture(await createImageBitmap(blob));
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.flipY = false;
  texture.anisotropy = 4;
  texture.needsUpdate = true;
  return texture;
}
