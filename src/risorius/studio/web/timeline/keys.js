/**
 * Keys drawn by hand on a graph: lists of [time, value], or with a shape (`key_shapes.js`), whose times rise.
 */

const APART = 0.005; // s between two keys at least
const TETHER = 0.15; // s in which a drawn curve leaves what was there, and meets it again

/**
 * The keys with one more.
 * @param {{duration: number, valueAt: (time: number) => number}} around the curve as it was
 */
export function withKey(keys, time, value, around) {
  const rest = keys.filter(([other]) => Math.abs(other - time) >= APART);
  return tethered(rest, [[time, value]], around);
}

/** Keys and new ones among them; where there are none beyond these, they are tied to the curve as it was. */
function tethered(keys, added, { duration, valueAt }) {
  const [first, last] = [added[0][0], added.at(-1)[0]];
  const ties = [];
  if (!keys.some(([time]) => time < first)) ties.push(Math.max(0, first - TETHER));
  if (!keys.some(([time]) => time > last)) ties.push(Math.min(duration, last + TETHER));
  const apart = ties.filter((time) => time <= first - APART || time >= last + APART);
  return sorted([...keys, ...added, ...apart.map((time) => [time, valueAt(time)])]);
}

/** The keys with one elsewhere, kept between its neighbours. */
export function withMoved(keys, index, time, value, duration) {
  const low = index > 0 ? keys[index - 1][0] + APART : 0;
  const high = index < keys.length - 1 ? keys[index + 1][0] - APART : duration;
  return keys.map((key, k) => (k === index ? [Math.max(low, Math.min(time, high)), value, ...key.slice(2)] : key));
}

export function without(keys, index) {
  return keys.filter((_, k) => k !== index);
}

/** The keys with a line drawn freely in place of those under it. @param {[number, number][]} line any order */
export function withLine(keys, line, tolerance, around) {
  const drawn = simplified(sorted(line), tolerance);
  const [from, to] = [drawn[0][0], drawn.at(-1)[0]];
  const outside = keys.filter(([time]) => time < from - APART || time > to + APART);
  return tethered(outside, drawn, around);
}

function sorted(keys) {
  const rising = [...keys].sort((a, b) => a[0] - b[0]);
  return rising.filter((key, k) => k === 0 || key[0] - rising[k - 1][0] > 1e-6);
}

/** The fewest points from which the line is nowhere further than `tolerance` (Douglas and Peucker 1973). */
export function simplified(line, tolerance) {
  const kept = [];
  const parts = [[0, line.length - 1]];
  const chosen = new Set([0, line.length - 1]);
  while (parts.length > 0) {
    const [first, last] = /** @type {number[]} */ (parts.pop());
    const far = furthest(line, first, last, tolerance);
    if (far === null) continue;
    chosen.add(far);
    parts.push([first, far], [far, last]);
  }
  for (const k of [...chosen].sort((a, b) => a - b)) kept.push(line[k]);
  return kept;
}

function furthest(line, first, last, tolerance) {
  let [far, most] = [null, tolerance];
  const [[t0, v0], [t1, v1]] = [line[first], line[last]];
  for (let k = first + 1; k < last; k++) {
    const [time, value] = line[k];
    const straight = v0 + ((v1 - v0) * (time - t0)) / (t1 - t0);
    if (Math.abs(value - straight) > most) [far, most] = [k, Math.abs(value - straight)];
  }
  return far;
}

/** Index of the key within `reach` pixels of a point, or -1. */
export function keyNear(keys, place, x, y, reach) {
  return keys.findIndex((key) => {
    const [keyX, keyY] = place(key);
    return Math.abs(keyX - x) <= reach && Math.abs(keyY - y) <= reach;
  });
}
