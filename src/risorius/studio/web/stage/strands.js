/**
 * Hairs as ribbons: strands that follow one another, each of as many pairs of vertices, its left and its right
 * edge from root to tip. A machine without a graphics card draws fewer and straighter ones in motion.
 */

const GOLDEN = 0.6180339887498949;
const QUAD = [0, 1, 2, 1, 3, 2];

/**
 * Some of the strands, spread evenly, with two bends' worth of triangles instead of all.
 * @param {Uint32Array} index (3m,) @param {number} share of the strands
 * @returns {{order: number[], index: Uint32Array}} the vertices that are kept, and the triangles between these
 */
export function fewer(index, share) {
  const { count, pairs } = strandsOf(index);
  const kept = [0, pairs >> 1, pairs - 1];
  const strands = Array.from({ length: count }, (_, k) => k).filter((k) => (k * GOLDEN) % 1 < share);
  const order = strands.flatMap((strand) =>
    kept.flatMap((pair) => [0, 1].map((edge) => 2 * (strand * pairs + pair) + edge)),
  );
  const each = kept.length - 1;
  const quads = Array.from({ length: strands.length * each }, (_, k) => 2 * (k + Math.floor(k / each)));
  return { order, index: Uint32Array.from(quads.flatMap((from) => QUAD.map((k) => from + k))) };
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

/** How many strands, and of how many pairs: the second begins where none of the first's vertices is met. */
function strandsOf(index) {
  let [highest, each] = [Math.max(index[0], index[1], index[2]), index.length];
  for (let k = 3; k < index.length && each === index.length; k += 3) {
    if (Math.min(index[k], index[k + 1], index[k + 2]) > highest) each = k;
    else highest = Math.max(highest, index[k], index[k + 1], index[k + 2]);
  }
  return { count: index.length / each, pairs: (highest + 1) / 2 };
}
