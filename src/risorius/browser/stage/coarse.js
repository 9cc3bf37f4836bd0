/**
 * The coarse head, with an eighth of the triangles, for files played in a browser without a graphics card.
 * There a triangle smaller than a pixel costs as much as a larger one.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { computeNormals } from "./normals.js";
import { fewer } from "./strands.js";
/** @import {Few, Mesh, Spots} from "../types.js" */

/** @typedef {(points: Float32Array, index: Uint32Array, spots: Spots) => Few} Lighten */

// Radius in mm within which vertices of the skin are merged: small at eyes and mouth, growing by SLOPE beyond NEAR.
const [LEAST, MOST, NEAR, SLOPE] = [1.7, 9, 10, 0.38];
const AROUND = 25; // mm from the midst of an eye within which they are
const SUNK = 0.982; // scale of the eyeballs: coarse lids do not quite cover them when shut
const GATHERED = 1.5; // mm, in the mouth
const [EYES, SMALL] = [["eye_left", "eye_right"], ["teeth_upper", "teeth_lower", "tongue"]];
const ROUND = 1.6; // mm, on the eyeballs
const [BESIDE, EDGE] = [2.6, 0.5]; // mm from the vertices of lids' margins, which lashes darken, up to which skin is finer still
// The share of the hair's strands that is drawn, and their widening: strands thinner than a pixel glitter.
/** @type {Record<string, {share: number, wide: number}>} */
const STRANDS = {
  brows: { share: 0.35, wide: 3 },
  lashes: { share: 1, wide: 1 },
  hair: { share: 0.28, wide: 2.9 },
  hairline: { share: 0.35, wide: 2 },
};

/** @type {Record<string, Lighten>} */
const LIGHTER = {
  skin: (points, index, spots) => coarser(points, index, reachFrom(spots)),
  ...gathering(SMALL, GATHERED),
  ...gathering(EYES, ROUND),
  ...Object.fromEntries(
    Object.entries(STRANDS).map(([name, { share }]) => [name, /** @type {Lighten} */ ((points, index) => fewer(index, share, points))]),
  ),
};

/**
 * @param {string} name @param {Mesh} mesh at rest, mm
 * @param {Spots} spots points around which the skin stays fine
 * @returns {Lighter | null} null points around which all triangles stay
 */
export function lighterOf(name, mesh, spots) {
  const { attributes, index } = /** @type {any} */ (mesh.geometry);
  const few = LIGHTER[name]?.(attributes.position.array, index.array, spots);
  if (!few) return null;
  const lighter = new Lighter(mesh, few, STRANDS[name]?.wide ?? 1);
  if (EYES.includes(name)) lighter.mesh.geometry.scale(SUNK, SUNK, SUNK);
  return lighter;
}

/** A mesh with some of another's vertices, drawn in its place. */
export class Lighter {
  #full;
  #order;
  #wide;

  /**
   * @param {Mesh} full @param {Few} few
   * @param {number} wide how much wider ribbons are; 1 for other meshes
   */
  constructor(full, { order, index }, wide) {
    this.#full = full;
    this.#wide = wide;
    this.#order = Uint32Array.from(order);
    const geometry = new THREE.BufferGeometry().setIndex(new THREE.BufferAttribute(index, 1));
    this.mesh = new THREE.Mesh(geometry, /** @type {any} */ ([full.material].flat()[0]).userData.quick ?? full.material);
    this.mesh.frustumCulled = false;
    this.mesh.matrixAutoUpdate = false;
    this.mesh.matrix = full.matrix; // both have the same place
    this.mesh.renderOrder = full.renderOrder;
    for (const name of Object.keys(full.geometry.attributes)) this.take(name);
  }

  /** Take an attribute of the vertices from the full mesh as it is now. @param {string} name */
  take(name) {
    const { attributes } = this.mesh.geometry;
    const { array, itemSize, normalized, usage } = /** @type {any} */ (this.#full.geometry.attributes[name]);
    if (!attributes[name]) {
      const own = new array.constructor(itemSize * this.#order.length);
      attributes[name] = new THREE.BufferAttribute(own, itemSize, normalized).setUsage(usage);
    }
    const own = /** @type {any} */ (attributes[name].array);
    for (let k = 0, to = 0; k < this.#order.length; k++) {
      for (let from = itemSize * this.#order[k], end = from + itemSize; from < end; ) own[to++] = array[from++];
    }
    if (name === "breadth") for (let k = 0; k < own.length; k++) own[k] *= this.#wide;
    attributes[name].needsUpdate = true;
  }
}

/** @param {THREE.BufferGeometry} geometry mesh whose normals are computed from its current vertices */
export function shade(geometry) {
  const { attributes, index } = /** @type {any} */ (geometry);
  computeNormals(attributes.position.array, index.array, attributes.normal.array);
  attributes.normal.needsUpdate = true;
}

/** @param {string[]} names @param {number} reach @returns {Record<string, Lighten>} */
function gathering(names, reach) {
  return Object.fromEntries(names.map((name) => [name, /** @type {Lighten} */ ((points, index) => coarser(points, index, () => reach))]));
}

/** @param {Spots} spots @returns {(x: number, y: number, z: number) => number} */
function reachFrom({ eyes, edges, mouth }) {
  return (x, y, z) => {
    /** @param {number[]} place */
    const away = ([a, b, c]) => Math.hypot(x - a, y - b, z - c);
    const near = Math.min(...eyes.map(away), away(mouth));
    if (near < AROUND && edges.some((edge) => away(edge) < BESIDE)) return EDGE;
    return Math.min(Math.max(SLOPE * (near - NEAR), LEAST), MOST);
  };
}

/**
 * Merge vertices into groups along the mesh's edges; triangles that join three groups remain,
 * between the groups' central vertices. Vertices at the mesh's borders stay.
 * @param {ArrayLike<number>} points x, y, z, x, … @param {Uint32Array} index (3m,)
 * @param {(x: number, y: number, z: number) => number} reach radius of each vertex's group, in the units of the points
 * @returns {{order: number[], index: Uint32Array}} the the remaining vertices, and the triangles between them
 */
export function coarser(points, index, reach) {
  const edges = edgesOf(index, points);
  const heads = headsOf(points, edges, reach);
  const found = [];
  for (let k = 0; k < index.length; k += 3) {
    const [a, b, c] = [heads[index[k]], heads[index[k + 1]], heads[index[k + 2]]];
    if (a !== b && b !== c && c !== a) found.push(a, b, c);
  }
  return compacted(found);
}

/** Return the vertices that triangles use, and the triangles renumbered to these. @param {number[]} triangles */
function compacted(triangles) {
  const order = [...new Set(triangles)];
  const places = new Map(order.map((vertex, place) => [vertex, place]));
  return { order, index: Uint32Array.from(triangles, (vertex) => /** @type {number} */ (places.get(vertex))) };
}

/**
 * @param {Uint32Array} index @param {ArrayLike<number>} points
 * @returns {{starts: Uint32Array, ends: Uint32Array, lengths: Float32Array, border: Uint8Array}} neighbours of
 *   vertex v: `ends[starts[v]] … ends[starts[v + 1] - 1]`, each twice except at borders
 */
function edgesOf(index, points) {
  const count = points.length / 3;
  const starts = new Uint32Array(count + 1);
  for (const vertex of index) starts[vertex + 1] += 2;
  for (let v = 0; v < count; v++) starts[v + 1] += starts[v];
  const [ends, free] = [new Uint32Array(2 * index.length), starts.slice()];
  for (let k = 0; k < index.length; k++) {
    const [a, b] = [index[k], index[k % 3 === 2 ? k - 2 : k + 1]];
    ends[free[a]++] = b;
    ends[free[b]++] = a;
  }
  const lengths = new Float32Array(ends.length);
  const border = new Uint8Array(count);
  for (let v = 0; v < count; v++) {
    const own = ends.subarray(starts[v], starts[v + 1]).sort();
    own.forEach((other, k) => (lengths[starts[v] + k] = between(points, v, other)));
    border[v] = own.some((other, k) => own[k - 1] !== other && own[k + 1] !== other) ? 1 : 0;
  }
  return { starts, ends, lengths, border };
}

/**
 * Return the central vertex of each vertex's group: the nearest one that stays.
 * @param {ArrayLike<number>} points @param {ReturnType<typeof edgesOf>} edges
 * @param {(x: number, y: number, z: number) => number} reach
 */
function headsOf(points, { starts, ends, lengths, border }, reach) {
  const heads = Uint32Array.from(border, (_, vertex) => vertex);
  const own = Float32Array.from(border, (_, v) => reach(points[3 * v], points[3 * v + 1], points[3 * v + 2]));
  const far = new Float32Array(border.length).fill(Infinity);
  /** @param {number} from */
  const spread = (from) => {
    const waiting = [from];
    far[from] = 0;
    heads[from] = from;
    for (let v = waiting.pop(); v !== undefined; v = waiting.pop()) {
      for (let k = starts[v]; k < starts[v + 1]; k++) {
        const [other, there] = [ends[k], far[v] + lengths[k]];
        if (there >= far[other] || there > Math.min(own[from], own[other]) || border[other]) continue;
        [far[other], heads[other]] = [there, heads[v]];
        waiting.push(other);
      }
    }
  };
  border.forEach((stays, vertex) => stays && (far[vertex] = 0));
  for (let v = 0; v < border.length; v++) if (far[v] === Infinity) spread(v);
  return heads;
}

/** @param {ArrayLike<number>} points @param {number} a @param {number} b */
function between(points, a, b) {
  /** @param {number} k */
  const axis = (k) => points[3 * a + k] - points[3 * b + k];
  return Math.hypot(axis(0), axis(1), axis(2));
}
