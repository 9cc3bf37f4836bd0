/** How far the lips are apart, which is how much light comes to the teeth. */

const WIDE = 6; // mm of the mouth's width that are looked at together
const [SHUT, OPEN] = [0.8, 4]; // mm between the lips: no light comes between them, all that will

/**
 * Pairs of points of the upper and the lower lip, in groups that stand over one another.
 * @param {[number, number][]} pairs of vertices @param {Float32Array} points of the skin at rest, mm
 * @returns {[number, number][][]}
 */
export function slitsOf(pairs, points) {
  const groups = new Map();
  for (const [upper, lower] of pairs) {
    const place = Math.round(points[3 * upper] / WIDE);
    groups.set(place, [...(groups.get(place) ?? []), [upper, lower]]);
  }
  return [...groups.values()];
}

/**
 * The share of the light that comes in: where the lips are farthest apart, and there between those of their
 * points that are nearest to each other.
 * @param {[number, number][][]} slits @param {Float32Array} points mm @returns {number} 0 to 1
 */
export function lightBetween(slits, points) {
  const gaps = slits.map((pairs) =>
    Math.min(...pairs.map(([upper, lower]) => points[3 * upper + 1] - points[3 * lower + 1])),
  );
  const share = Math.min(Math.max((Math.max(...gaps) - SHUT) / (OPEN - SHUT), 0), 1);
  return share * share * (3 - 2 * share);
}
