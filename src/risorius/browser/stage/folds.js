/** The places of a head's fine wrinkles, and their heights in a face (`head_folds.py`). */

import * as THREE from "../vendor/three/three.module.min.js";

/** @import {StageFolds} from "../wire.js" */

/**
 * @param {ArrayBuffer} places as the server packs them
 * @param {StageFolds} described @param {number} vertices of the skin
 */
function unpackFolds(places, { count, slots }, vertices) {
  const entries = slots * vertices;
  return {
    targets: new Uint32Array(places, 0, count),
    regions: new Uint8Array(places, 4 * count, entries),
    places: new Uint16Array(places, 4 * count + entries, 4 * entries),
  };
}

export class Folds {
  #targets;
  #heights;

  /**
   * @param {THREE.BufferGeometry} geometry the skin's; it receives the attributes for its shader
   * @param {ArrayBuffer} places @param {StageFolds} described
   */
  constructor(geometry, places, described) {
    const { slots } = described;
    const vertices = geometry.attributes.position.count;
    const folds = unpackFolds(places, described, vertices);
    this.#targets = folds.targets;
    this.#heights = new THREE.BufferAttribute(new Uint8Array(slots * vertices), slots).setUsage(THREE.DynamicDrawUsage);
    geometry.setAttribute("foldHeight", this.#heights);
    geometry.setAttribute("foldRegion", new THREE.BufferAttribute(folds.regions, slots));
    for (let slot = 0; slot < slots; slot++) {
      const own = new Uint16Array(4 * vertices);
      for (let vertex = 0; vertex < vertices; vertex++) {
        const from = 4 * (slots * vertex + slot);
        own.set(folds.places.subarray(from, from + 4), 4 * vertex);
      }
      geometry.setAttribute(`foldPlace${slot}`, new THREE.Float16BufferAttribute(own, 4));
    }
  }

  /** Set the heights to a blend of two faces'. @param {ArrayLike<number>} a @param {ArrayLike<number>} b @param {number} share */
  raise(a, b, share) {
    const heights = /** @type {Uint8Array} */ (this.#heights.array);
    this.#targets.forEach((target, k) => (heights[target] = a[k] + share * (b[k] - a[k]) + 0.5));
    this.#heights.needsUpdate = true;
  }
}
