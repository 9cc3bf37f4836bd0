/**
 * Hairs as ribbons: strands one after another, each with the same number of pairs of vertices, on its left and right
 * edge from root to tip. A machine without a graphics card draws fewer and straighter ones in motion.
 *
 * Ribbons are blended with soft edges over the background (`hair.js`), so the far ones
 * are drawn first.
 */

import * as THREE from "../vendor/three/three.module.min.js";
/** @import {Mesh} from "../types.js" */

const ALIKE = Math.cos((5 * Math.PI) / 180); // between viewing directions that share one order
const DEPTHS = 1024; // depths that are distinguished
const SHORT = 40; // mm
const GOLDEN = 0.6180339887498949;
const QUAD = [0, 1, 2, 1, 3, 2];

/**
 * Return some of the strands, spread evenly; short ones with one bend, long ones with half of theirs: fewer would cut through the head.
 * @param {Uint32Array} index (3m,) @param {number} share of the strands @param {Float32Array} points x, y, z, x, …
 * @returns {{order: number[], index: Uint32Array}} the the remaining vertices, and the triangles between them
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

/** Return the first pairs (hair bends most there), every second one of the others, and the tip. @param {number} pairs */
function secondOf(pairs) {
  return Array.from({ length: pairs }, (_, k) => k).filter((k) => k < 4 || k % 2 === 1 || k === pairs - 1);
}

/** Return the mean length of strands, along their left edges. @param {Float32Array} points @param {number} count @param {number} pairs */
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

/**
 * Add attributes to a mesh of ribbons: `breadth` (half the ribbon's width in mm, and half the width of the thinnest hairs
 * for which this one is left out, `render/ribbons.py`) and `along` (the strand's direction, see `follow`).
 * @param {Mesh} mesh
 */
export function asStrands({ geometry }) {
  const { attributes, index } = /** @type {any} */ (geometry);
  const { array } = attributes.position;
  const { pairs } = (geometry.userData = strandsOf(index.array));
  const breadth = new Float32Array((2 * array.length) / 3);
  for (let pair = 0, thinnest = 0; 6 * pair < array.length; pair++) {
    const half = Math.hypot(...[0, 1, 2].map((axis) => array[6 * pair + axis] - array[6 * pair + axis + 3])) / 2;
    if (pair % pairs === 0) thinnest = half / Math.max(((pair / pairs) * GOLDEN) % 1, 1e-6);
    breadth.set([half, thinnest, half, thinnest], 4 * pair);
  }
  geometry.setAttribute("breadth", new THREE.BufferAttribute(breadth, 2));
  geometry.setAttribute("along", new THREE.BufferAttribute(new Float32Array(array.length), 3));
  follow(geometry);
}

/**
 * Move both edges of the ribbons to the centre line (shaders move them apart), and set the strand's unit direction at each
 * vertex, as the library's ribbons do: towards the next pair; at the tip, that of the pair before.
 * @param {THREE.BufferGeometry} geometry of strands whose edges were just moved
 */
export function follow({ attributes, userData }) {
  const [points, ways] = [attributes.position.array, attributes.along.array];
  for (let k = 0; k < points.length; k += 6) {
    for (let axis = k; axis < k + 3; axis++) points[axis] = points[axis + 3] = (points[axis] + points[axis + 3]) / 2;
  }
  for (let pair = 0, k = 0; k < points.length; pair++, k += 6) {
    const from = pair % userData.pairs === userData.pairs - 1 ? k - 6 : k;
    const [x, y, z] = [points[from + 6] - points[from], points[from + 7] - points[from + 1], points[from + 8] - points[from + 2]];
    const length = Math.sqrt(x * x + y * y + z * z) || 1;
    ways[k] = ways[k + 3] = x / length;
    ways[k + 1] = ways[k + 4] = y / length;
    ways[k + 2] = ways[k + 5] = z / length;
  }
}

/** Sorts a mesh's strands by distance, farthest first, when the camera moves, and leaves out the hidden ones. */
export class Order {
  #geometry;
  #index;
  #strands;
  #sorted = new THREE.Vector3();
  #depths;
  #cover;

  /**
   * @param {THREE.BufferGeometry} geometry of strands
   * @param {import("./cover.js").Cover | null} cover surface that may hide some; null for strands that move with the face
   */
  constructor(geometry, cover = null) {
    this.#geometry = geometry;
    this.#cover = cover;
    this.#index = /** @type {any} */ (geometry.index).array.slice();
    this.#strands = strandsOf(this.#index);
    this.#depths = new Float32Array(this.#strands.count);
  }

  /** @param {THREE.Vector3} sight away from the camera, of unit length, in the mesh's own frame */
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
 * Return the number of strands and of pairs in each: the second begins at the first triangle that shares no vertex with those before.
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
