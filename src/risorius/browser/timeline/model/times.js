import { firstAbove } from "./spans.js";
/** @import {Times} from "../../types.js" */

/**
 * The four times of a block, [start, end of onset, start of offset, end] in seconds, and edits of them.
 */

export const LEAST = 0.01; // s: no block is made shorter

/** @param {import("../../wire.js").Block} block @returns {number[]} */
export function timesOf(block) {
  return [block.start, block.apex_start, block.apex_end, block.end];
}

/**
 * Return the times of a block moved within [0, duration].
 * @param {Times} times @param {number} delta @param {number} duration @returns {Times}
 */
export function moved(times, delta, duration) {
  const bound = Math.max(-times[0], Math.min(delta, Math.max(duration - times[3], -times[0])));
  return times.map((time) => time + bound);
}

/**
 * Return the times of a block with one of them changed. Changing start or end keeps the length of onset and
 * offset if both fit; otherwise both shrink in proportion.
 * @param {Times} times @param {number} time @param {number} duration @returns {Times}
 * @param {number} handle 0 start, 1 end of onset, 2 start of offset, 3 end
 */
export function pulled(times, handle, time, duration) {
  const [start, rise, fall, end] = times;
  if (handle === 1) return [start, within(time, start, fall), fall, end];
  if (handle === 2) return [start, rise, within(time, rise, end), end];
  const from = handle === 0 ? within(time, 0, end - LEAST) : start;
  const to = handle === 3 ? within(time, start + LEAST, Math.max(duration, end)) : end;
  return fitted(from, to, rise - start, end - fall);
}

/** @param {number} start @param {number} end @param {number} onset @param {number} offset @returns {Times} */
function fitted(start, end, onset, offset) {
  const share = Math.min(1, (end - start) / Math.max(onset + offset, 1e-9));
  return [start, start + onset * share, end - offset * share, end];
}

/** @param {number} value @param {number} low @param {number} high */
function within(value, low, high) {
  return Math.max(low, Math.min(value, high));
}

/**
 * Return the fields of the wire's edit that turns `before` into `after`.
 * @param {Times} before @param {Times} after
 * @returns {{kind: string, fields: Record<string, number>} | null} null if they are the same
 */
export function editOf(before, after) {
  /** @param {number} k */
  const same = (k) => Math.abs(after[k] - before[k]) < 1e-6;
  if ([0, 1, 2, 3].every(same)) return null;
  const shift = after[0] - before[0];
  if ([1, 2, 3].every((k) => Math.abs(after[k] - before[k] - shift) < 1e-6)) {
    return { kind: "move", fields: { start: after[0] } };
  }
  /** @type {Record<string, number>} */
  const fields = {};
  if (!same(0)) fields.start = after[0];
  if (!same(3)) fields.end = after[3];
  if (same(0) && !same(1)) fields.onset = after[1] - after[0];
  if (same(3) && !same(2)) fields.offset = after[3] - after[2];
  return { kind: "stretch", fields };
}

/**
 * Stretch several blocks together: time `fixed` stays, time `from` moves to `to`.
 * @param {number} fixed @param {number} from @param {number} to @param {number} duration @returns {Times[]}
 * @param {number[][]} all the times of each block
 */
export function stretchedTogether(all, fixed, from, to, duration) {
  const shortest = Math.min(...all.map(([start, , , end]) => end - start));
  const room = from > fixed ? (duration - fixed) / (from - fixed) : fixed / (fixed - from);
  const share = within((to - fixed) / (from - fixed), LEAST / shortest, Math.max(room, 1));
  return all.map((times) => times.map((time) => fixed + (time - fixed) * share));
}

/**
 * Return the fields of the wire's edit that sets a block's times, with onset and offset.
 * @param {Times} times @returns {{kind: string, fields: Record<string, number>}}
 */
export function stretchTo([start, rise, fall, end]) {
  return { kind: "stretch", fields: { start, end, onset: rise - start, offset: end - fall } };
}

/**
 * Return the nearest of the sorted times within `reach`, or null.
 * @param {Float64Array} edges @param {number} time @param {number} reach @returns {number | null}
 */
export function nearest(edges, time, reach) {
  const k = firstAbove(edges, time);
  const close = [edges[k - 1], edges[k]].filter((edge) => Math.abs(edge - time) <= reach);
  return close.sort((a, b) => Math.abs(a - time) - Math.abs(b - time))[0] ?? null;
}

/**
 * Return the extra shift that brings a moved block's start or end to an edge; 0 if none is near.
 * @param {Float64Array} edges @param {Times} times @param {number} reach
 */
export function snappedBy(edges, times, reach) {
  const ways = [times[0], times[3]].map((time) => {
    const edge = nearest(edges, time, reach);
    return edge === null ? null : edge - time;
  });
  return ways.filter((way) => way !== null).sort((a, b) => Math.abs(a) - Math.abs(b))[0] ?? 0;
}
