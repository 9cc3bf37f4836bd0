/** Occlusion of hair by the head and other hair: hidden strands at the back are not drawn, as in the library. */

import * as THREE from "../vendor/three/three.module.min.js";

const CELL = 8; // mm
const CELLS = 64; // each way
const [BEHIND, DEEP] = [5, 20]; // mm behind the head and behind other hair where hair is hidden
const AROUND = 2; // cells around a place that must hide it, too: the head turns a little between updates

export class Cover {
  #head;
  #hair;
  #across = new THREE.Vector3();
  #up = new THREE.Vector3();
  #ahead = new THREE.Vector3();
  #nearest = new Float32Array(CELLS * CELLS);
  #hidden = new Float32Array(CELLS * CELLS);

  /**
   * @param {Float32Array} head points of the skin that turn with it, mm, in the frame of the hair: x, y, z, x, …
   * @param {ArrayLike<number>} hair points of the hair
   */
  constructor(head, hair) {
    this.#head = head;
    this.#hair = hair;
  }

  /** Update for the direction `sight`, away from the camera. @param {THREE.Vector3} sight of unit length */
  look(sight) {
    this.#ahead.copy(sight).negate();
    this.#across.set(sight.z, 0, -sight.x);
    if (this.#across.lengthSq() < 1e-6) this.#across.set(1, 0, 0);
    this.#across.normalize();
    this.#up.crossVectors(this.#ahead, this.#across);
    this.#nearest.fill(-Infinity);
    this.#stand(this.#head, BEHIND);
    this.#stand(this.#hair, DEEP);
    for (let row = 0; row < CELLS; row++) for (let column = 0; column < CELLS; column++) this.#least(row, column);
  }

  /** Whether the head hides a place. @param {ArrayLike<number>} points @param {number} k index of its x */
  hides(points, k) {
    const cell = this.#cell(points, k);
    return cell >= 0 && dot(this.#ahead, points, k) < this.#hidden[cell];
  }

  /** @param {ArrayLike<number>} points @param {number} behind distance in mm behind the points from which things are hidden */
  #stand(points, behind) {
    for (let k = 0; k < points.length; k += 3) {
      const cell = this.#cell(points, k);
      if (cell >= 0) this.#nearest[cell] = Math.max(this.#nearest[cell], dot(this.#ahead, points, k) - behind);
    }
  }

  /** @param {number} row @param {number} column */
  #least(row, column) {
    let least = Infinity;
    for (let y = row - AROUND; y <= row + AROUND; y++) {
      for (let x = column - AROUND; x <= column + AROUND; x++) {
        const within = x >= 0 && y >= 0 && x < CELLS && y < CELLS;
        least = Math.min(least, within ? this.#nearest[y * CELLS + x] : -Infinity);
      }
    }
    this.#hidden[row * CELLS + column] = least;
  }

  /** @param {ArrayLike<number>} points @param {number} k */
  #cell(points, k) {
    const column = Math.floor(dot(this.#across, points, k) / CELL) + CELLS / 2;
    const row = Math.floor(dot(this.#up, points, k) / CELL) + CELLS / 2;
    return column >= 0 && row >= 0 && column < CELLS && row < CELLS ? row * CELLS + column : -1;
  }
}

/** @param {THREE.Vector3} way @param {ArrayLike<number>} points @param {number} k */
function dot({ x, y, z }, points, k) {
  return x * points[k] + y * points[k + 1] + z * points[k + 2];
}
