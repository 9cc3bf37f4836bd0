import { swept } from "./sweep.js";

/**
 * A mesh with fewer triangles and vertices, for machines that draw without a graphics card while the face moves:
 * a triangle smaller than a pixel costs them what a larger one does.
 */

/**
 * Vertices gather round some of them, along the mesh's edges; triangles that join three such groups are left,
 * between the vertices in their midst. Vertices at the mesh's borders stay.
 * @param {ArrayLike<number>} points x, y, z, x, … @param {Uint32Array} index (3m,)
 * @param {(x: number, y: number, z: number) => number} reach how far a vertex gathers others, and is gathered, in points' units
 * @returns {{order: number[], index: Uint32Array}} the vertices that are kept, and the triangles between these
 */
export function coarser(points, index, reach) {
  const edges = edgesOf(index, points);
  const heads = headsOf(points, edges, reach);
  const found = [];
  for (let k = 0; k < index.length; k += 3) {
    const [a, b, c] = [heads[index[k]], heads[index[k + 1]], heads[index[k + 2]]];
    if (a !== b && b !== c && c !== a) found.push(a, b, c);
  }
  return swept(Uint32Array.from(found));
}

/**
 * @param {Uint32Array} index @param {ArrayLike<number>} points
 * @returns {{starts: Uint32Array, ends: Uint32Array, lengths: Float32Array, border: Uint8Array}} neighbours of
 *   vertex v: `ends[starts[v]] … ends[starts[v + 1] - 1]`, each twice but at borders
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
 * The vertex round which each one gathers: the nearest of those that stay.
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
