/**
 * Keys drawn by hand on a graph: lists of [time, value], or with a shape (`key_shapes.js`), in order of time.
 */

/** @import {Around, Key} from "../../types.js" */

const APART = 0.005; // s between two keys at least
const TETHER = 0.15; // s of transition between a drawn curve and the earlier one

/**
 * Return the keys with one added.
 * @param {Key[]} keys @param {number} time @param {number} value @returns {Key[]}
 * @param {{duration: number, valueAt: (time: number) => number}} around the curve before
 */
export function withKey(keys, time, value, around) {
  const rest = keys.filter(([other]) => Math.abs(other - time) >= APART);
  return tethered(rest, [[time, value]], around);
}

/**
 * Return the keys with new ones added; an end with no key beyond it gets one more, on the curve before the edit.
 * @param {Key[]} keys @param {Key[]} added @param {Around} around @returns {Key[]}
 */
function tethered(keys, added, { duration, valueAt }) {
  const [first, last] = [added[0][0], added[added.length - 1][0]];
  const ties = [];
  if (!keys.some(([time]) => time < first)) ties.push(Math.max(0, first - TETHER));
  if (!keys.some(([time]) => time > last)) ties.push(Math.min(duration, last + TETHER));
  const apart = ties.filter((time) => time <= first - APART || time >= last + APART);
  return sorted([...keys, ...added, ...apart.map((time) => /** @type {Key} */ ([time, valueAt(time)]))]);
}

/**
 * Return the keys with one moved, limited by its neighbours.
 * @param {Key[]} keys @param {number} index @param {number} time @param {number} value @param {number} duration
 * @returns {Key[]}
 */
export function withMoved(keys, index, time, value, duration) {
  const low = index > 0 ? keys[index - 1][0] + APART : 0;
  const high = index < keys.length - 1 ? keys[index + 1][0] - APART : duration;
  const there = Math.max(low, Math.min(time, high));
  return keys.map((key, k) => (k !== index ? key : key.length > 2 ? [there, value, key[2]] : [there, value]));
}

/** @param {Key[]} keys @param {number} index */
export function without(keys, index) {
  return keys.filter((_, k) => k !== index);
}

/**
 * Return the keys with a freehand line in place of the keys under it.
 * @param {Key[]} keys @param {number} tolerance @param {Around} around @param {[number, number][]} line any order
 * @returns {Key[]}
 */
export function withLine(keys, line, tolerance, around) {
  const drawn = simplified(sorted(line), tolerance);
  const [from, to] = [drawn[0][0], drawn[drawn.length - 1][0]];
  const outside = keys.filter(([time]) => time < from - APART || time > to + APART);
  return tethered(outside, drawn, around);
}

/** @param {Key[]} keys */
function sorted(keys) {
  const rising = [...keys].sort((a, b) => a[0] - b[0]);
  return rising.filter((key, k) => k === 0 || key[0] - rising[k - 1][0] > 1e-6);
}

/**
 * Simplify a line to points within `tolerance` of it (Douglas and Peucker 1973).
 * @param {Key[]} line @param {number} tolerance @returns {Key[]}
 */
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

/** @param {Key[]} line @param {number} first @param {number} last @param {number} tolerance @returns {number | null} */
function furthest(line, first, last, tolerance) {
  /** @type {number | null} */
  let far = null;
  let most = tolerance;
  const [[t0, v0], [t1, v1]] = [line[first], line[last]];
  for (let k = first + 1; k < last; k++) {
    const [time, value] = line[k];
    const straight = v0 + ((v1 - v0) * (time - t0)) / (t1 - t0);
    if (Math.abs(value - straight) > most) [far, most] = [k, Math.abs(value - straight)];
  }
  return far;
}

/**
 * Return the index of the key within `reach` pixels of a point, or -1.
 * @param {Key[]} keys @param {(key: Key) => [x: number, y: number]} place @param {number} x @param {number} y
 * @param {number} reach
 */
export function keyNear(keys, place, x, y, reach) {
  return keys.findIndex((key) => {
    const [keyX, keyY] = place(key);
    return Math.abs(keyX - x) <= reach && Math.abs(keyY - y) <= reach;
  });
}
