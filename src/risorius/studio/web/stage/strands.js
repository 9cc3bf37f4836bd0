/**
 * Hairs as ribbons: strands that follow one another, each of as many pairs of vertices, its left and its right
 * edge from root to tip. A machine without a graphics card draws fewer and straighter ones in motion.
 *
 * Ribbons are drawn with soft edges over what is behind them (`hair.js`), so that those far away
 * come first.
 */

import * as THREE from "../vendor/three/three.module.min.js";
/** @import {Mesh} from "../types.js" */

const ALIKE = Math.cos((5 * Math.PI) / 180); // between directions of sight for which one order does
const DEPTHS = 1024; // that are told apart
const SHORT = 40; // mm
const GOLDEN = 0.6180339887498949;
const QUAD = [0, 1, 2, 1, 3, 2];

/**
 * Some of the strands, spread evenly; short ones with one bend, long ones with half of theirs: with fewer they would cut through the head.
 * @param {Uint32Array} index (3m,) @param {number} share of the strands @param {Float32Array} points x, y, z, x, …
 * @returns {{order: number[], index: Uint32Array}} the vertices that are kept, and the triangles between these
 */
export function fewer(index, share, points) {
  const { count, pairs } = strandsOf(index);
  const long = meanLength(points, count, pairs) > SHORT;
  const kept = long ? secondOf(pairs) : [0, pairs >> 1, pairs - 1];
  const strands = Array.from({ length: count }, (_, k) => k).filter((k) => (k * GOLDEN) % 1 < share);
  const order = strands.flatMap((strand) =>
    kept.flatMap((pair) => [0, 1].map((edge) => 2 * (strand * pairs + pair) + edge)),
  );
  const each = kept.length - 1;
  const quads = Array.from({ length: strands.length * each }, (_, k) => 2 * (k + Math.floor(k / each)));
  return { order, index: Uint32Array.from(quads.flatMap((from) => QUAD.map((k) => from + k))) };
}

/** The first pairs, where hair bends most, of the others every second one, and the tip. @param {number} pairs */
function secondOf(pairs) {
  return Array.from({ length: pairs }, (_, k) => k).filter((k) => k < 4 || k % 2 === 1 || k === pairs - 1);
}

/** How long strands are, along their left edges. @param {Float32Array} points @param {number} count @param {number} pairs */
function meanLength(points, count, pairs) {
  let sum = 0;
  for (let strand = 0; strand < count; strand++) {
    for (let pair = strand * pairs; pair < (strand + 1) * pairs - 1; pair++) {
      /** @param {number} axis */
      const way = (axis) => points[6 * pair + 6 + axis] - points[6 * pair + axis];
      sum += Math.hypot(way(0), way(1), way(2));
    }
  }
  return sum / Math.max(count, 1);
}

/** Make ribbons wider. @param {Float32Array} points in pairs @param {number} wide times as wide */
export function widen(points, wide) {
  for (let k = 0; k < points.length; k += 6) {
    for (let axis = k; axis < k + 3; axis++) {
      const [left, right] = [points[axis], points[axis + 3]];
      const [middle, half] = [(left + right) / 2, (wide * (right - left)) / 2];
      [points[axis], points[axis + 3]] = [middle - half, middle + half];
    }
  }
}

/**
 * Have a mesh know of each vertex how far and where the ribbon reaches from its midst, in mm: `across`, and in its last place
 * half of the breadth of the thinnest hairs for which this one is left out (`render/ribbons.py`); and where its strand runs,
 * of unit length: `along`.
 * @param {Mesh} mesh
 */
export function asStrands(mesh) {
  const { attributes, index } = /** @type {any} */ (mesh.geometry);
  const { array } = attributes.position;
  const { pairs } = strandsOf(index.array);
  const across = new Float32Array((4 * array.length) / 3);
  for (let pair = 0, thinnest = 0; 6 * pair < array.length; pair++) {
    const [from, to] = [6 * pair, 8 * pair];
    for (let axis = 0; axis < 3; axis++) {
      across[to + axis] = (array[from + axis] - array[from + axis + 3]) / 2;
      across[to + axis + 4] = -across[to + axis];
    }
    if (pair % pairs === 0) {
      const spread = Math.max(((pair / pairs) * GOLDEN) % 1, 1e-6);
      thinnest = Math.hypot(across[to], across[to + 1], across[to + 2]) / spread;
    }
    across[to + 3] = across[to + 7] = thinnest;
  }
  mesh.geometry.setAttribute("across", new THREE.BufferAttribute(across, 4));
  mesh.geometry.setAttribute("along", new THREE.BufferAttribute(directions(array, pairs), 3));
}

/**
 * Where strands run at each vertex, as the ribbons of the library: on to the next pair, at the tip as before it.
 * @param {Float32Array} points @param {number} pairs of a strand @returns {Float32Array} of unit length
 */
function directions(points, pairs) {
  const found = new Float32Array(points.length);
  for (let pair = 0; 6 * pair < points.length; pair++) {
    const from = 6 * (pair % pairs === pairs - 1 ? pair - 1 : pair);
    const way = [0, 1, 2].map((axis) => points[from + 6 + axis] + points[from + 9 + axis] - points[from + axis] - points[from + 3 + axis]);
    const length = Math.hypot(...way) || 1;
    for (let k = 0; k < 6; k++) found[6 * pair + k] = way[k % 3] / length;
  }
  return found;
}

/** Puts a mesh's strands in order, the farthest first, whenever it is looked at from elsewhere, and leaves out what is hidden. */
export class Order {
  #geometry;
  #index;
  #strands;
  #sorted = new THREE.Vector3();
  #depths;
  #cover;

  /**
   * @param {THREE.BufferGeometry} geometry of strands
   * @param {import("./cover.js").Cover | null} cover what hides some of them; null for strands that move with the face
   */
  constructor(geometry, cover = null) {
    this.#geometry = geometry;
    this.#cover = cover;
    this.#index = /** @type {any} */ (geometry.index).array.slice();
    this.#strands = strandsOf(this.#index);
    this.#depths = new Float32Array(this.#strands.count);
  }

  /** @param {THREE.Vector3} sight away from who looks, of unit length, in the mesh's own frame */
  sort(sight) {
    if (sight.dot(this.#sorted) > ALIKE) return;
    this.#sorted.copy(sight);
    const index = /** @type {any} */ (this.#geometry.index);
    const each = this.#index.length / this.#strands.count;
    let to = 0;
    this.#cover?.look(sight);
    for (const strand of this.#farthestFirst(sight)) {
      if (this.#hidden(strand)) continue;
      index.array.set(this.#index.subarray(strand * each, (strand + 1) * each), to);
      to += each;
    }
    index.array.fill(0, to); // triangles of one point, which are not drawn
    index.needsUpdate = true;
  }

  /** @param {number} strand */
  #hidden(strand) {
    const [cover, { pairs }] = [this.#cover, this.#strands];
    const points = this.#geometry.attributes.position.array;
    for (let pair = 0; cover && pair < pairs; pair++) {
      if (!cover.hides(points, 6 * (strand * pairs + pair))) return false;
    }
    return cover !== null;
  }

  /** @param {THREE.Vector3} sight */
  #farthestFirst({ x, y, z }) {
    const { count, pairs } = this.#strands;
    const points = this.#geometry.attributes.position.array;
    const depths = this.#depths;
    let [least, most] = [Infinity, -Infinity];
    for (let strand = 0; strand < count; strand++) {
      const k = 6 * (strand * pairs + (pairs >> 1));
      depths[strand] = -(x * points[k] + y * points[k + 1] + z * points[k + 2]);
      least = Math.min(least, depths[strand]);
      most = Math.max(most, depths[strand]);
    }
    const scale = (DEPTHS - 1) / Math.max(most - least, 1e-6);
    /** @param {number} strand */
    const place = (strand) => Math.floor((depths[strand] - least) * scale);
    const starts = new Uint32Array(DEPTHS + 1);
    for (let strand = 0; strand < count; strand++) starts[place(strand) + 1] += 1;
    for (let k = 0; k < DEPTHS; k++) starts[k + 1] += starts[k];
    const order = new Uint32Array(count);
    for (let strand = 0; strand < count; strand++) order[starts[place(strand)]++] = strand;
    return order;
  }
}

/**
 * How many strands, and of how many pairs: the second begins where none of the first's vertices is met.
 * @param {Uint32Array} index
 */
function strandsOf(index) {
  let [highest, each] = [Math.max(index[0], index[1], index[2]), index.length];
  for (let k = 3; k < index.length && each === index.length; k += 3) {
    if (Math.min(index[k], index[k + 1], index[k + 2]) > highest) each = k;
    else highest = Math.max(highest, index[k], index[k + 1], index[k + 2]);
  }
  return { count: index.length / each, pairs: (highest + 1) / 2 };
}
