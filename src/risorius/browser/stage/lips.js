/** The slit between the lips, through which light enters the mouth (`lip_edges` in `render/aperture.py`). */

const FAR = 40; // mm by which a pair stands farther apart than the nearest: those beyond do not count

/**
 * Write the slit's span of x, and the heights and depths of the upper and the lower lip from one corner to the other.
 * @param {[number, number][]} pairs of vertices of the upper and the lower lip @param {Float32Array} points of the skin, mm,
 *   before the head turns
 * @param {import("three").Vector2} span filled @param {import("three").Vector4[]} edges filled
 */
export function findSlit(pairs, points, span, edges) {
  const places = pairs.map(([upper, lower]) => (points[3 * upper] + points[3 * lower]) / 2);
  const gaps = pairs.map(([upper, lower]) => points[3 * upper + 1] - points[3 * lower + 1]);
  const [low, high, least] = [Math.min(...places), Math.max(...places), Math.min(...gaps)];
  const width = Math.max((high - low) / edges.length, 1e-6);
  span.set(low, high);
  edges.forEach((edge, k) => {
    const x = low + ((high - low) * k) / (edges.length - 1);
    const nearest = Math.min(...places.map((place) => Math.abs(place - x)));
    let total = 0;
    edge.set(0, 0, 0, 0);
    pairs.forEach(([upper, lower], pair) => {
      const away = Math.abs(places[pair] - x);
      const weight = Math.exp(-0.5 * (away / width) ** 2 - 0.5 * Math.min(gaps[pair] - least, FAR)) + (away === nearest ? 1e-12 : 0);
      total += weight;
      edge.x += weight * points[3 * upper + 1];
      edge.y += weight * points[3 * upper + 2];
      edge.z += weight * points[3 * lower + 1];
      edge.w += weight * points[3 * lower + 2];
    });
    edge.divideScalar(total);
  });
}
