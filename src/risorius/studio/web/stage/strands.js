/** Hair as strands that can be thinned out: fewer are drawn while a machine without graphics card is in motion. */

const GOLDEN = 0.6180339887498949;

/**
 * The triangles of all strands in another order: any first share of it is spread evenly over the head.
 * Strands follow one another in the index, each with as many triangles as the first.
 * @param {Uint32Array} index (3m,) @returns {{index: Uint32Array, strand: number}} `strand`: indices of a strand
 */
export function spreadStrands(index) {
  const strand = lengthOfFirst(index);
  const count = index.length / strand;
  if (!Number.isInteger(count)) return { index, strand: index.length };
  const order = Array.from({ length: count }, (_, k) => k);
  order.sort((a, b) => ((a * GOLDEN) % 1) - ((b * GOLDEN) % 1));
  const spread = new Uint32Array(index.length);
  order.forEach((from, to) => spread.set(index.subarray(from * strand, (from + 1) * strand), to * strand));
  return { index: spread, strand };
}

/** How many indices the first strand has: the next one has none of its vertices. */
function lengthOfFirst(index) {
  let highest = Math.max(index[0], index[1], index[2]);
  for (let k = 3; k < index.length; k += 3) {
    if (Math.min(index[k], index[k + 1], index[k + 2]) > highest) return k;
    highest = Math.max(highest, index[k], index[k + 1], index[k + 2]);
  }
  return index.length;
}
