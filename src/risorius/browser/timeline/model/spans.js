/**
 * Items with a start and an end, sorted by start: finding the visible ones, and stacking.
 */

/** @typedef {{start: number, end: number, layer: string}} Layered */

/**
 * Finds those of many spans that touch a stretch of time, without looking at all of them.
 * @template {{start: number, end: number}} T
 */
export class Spans {
  #reach;

  /** @param {T[]} items any order; `items` holds them in order of their starts */
  constructor(items) {
    this.items = [...items].sort((a, b) => a.start - b.start);
    let latest = -Infinity;
    this.#reach = Float64Array.from(this.items, ({ end }) => (latest = Math.max(latest, end)));
  }

  /** Those that touch [from, to], in order of their starts. @param {number} from @param {number} to */
  *within(from, to) {
    for (let i = firstAbove(this.#reach, from); i < this.items.length; i++) {
      const item = this.items[i];
      if (item.start > to) return;
      if (item.end >= from) yield item;
    }
  }

  /** The last that has started by `time` and not yet ended, or null. @param {number} time */
  at(time) {
    /** @type {T | null} */
    let found = null;
    for (const item of this.within(time, time)) if (time < item.end) found = item;
    return found;
  }
}

/**
 * Return the index of the first of the rising numbers that is at least `value`.
 * @param {ArrayLike<number>} numbers @param {number} value
 */
export function firstAbove(numbers, value) {
  let [low, high] = [0, numbers.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (numbers[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/**
 * Stack spans without overlap: each group stays together, on the lowest free rows.
 *
 * @template {Layered} T
 * @param {T[]} items
 * @returns {{rows: Map<T, number>, count: number}} the row of each item, and how many rows there are
 */
export function stacked(items) {
  const rows = new Map();
  /** @type {T[][]} */
  const taken = [];
  for (const group of grouped(items)) {
    const own = packed(group);
    let base = 0;
    while (group.some((item) => !free(taken[base + (own.get(item) ?? 0)], item))) base++;
    for (const item of group) {
      const row = base + (own.get(item) ?? 0);
      (taken[row] ??= []).push(item);
      rows.set(item, row);
    }
    for (const row of taken) row?.sort((a, b) => a.start - b.start);
  }
  return { rows, count: Math.max(taken.length, 1) };
}

/** @template {Layered} T @param {T[]} items @returns {T[][]} by layer, in order of their starts */
function grouped(items) {
  const groups = Map.groupBy(items, ({ layer }) => layer);
  return [...groups.keys()].sort().map((layer) => (groups.get(layer) ?? []).sort((a, b) => a.start - b.start));
}

const CLOSE = 1e-6; // s: spans that only touch do not hide each other

/**
 * Return the row of each item of one group: the lowest whose last item has ended.
 * @template {Layered} T @param {T[]} group @returns {Map<T, number>}
 */
function packed(group) {
  /** @type {number[]} */
  const ends = [];
  const rows = new Map();
  for (const item of group) {
    let row = ends.findIndex((end) => end <= item.start + CLOSE);
    if (row < 0) row = ends.length;
    ends[row] = item.end;
    rows.set(item, row);
  }
  return rows;
}

/** @param {Layered[] | undefined} row in order of time @param {Layered} item */
function free(row, item) {
  if (row === undefined) return true;
  let [low, high] = [0, row.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (row[middle].end <= item.start + CLOSE) low = middle + 1;
    else high = middle;
  }
  return low === row.length || row[low].start >= item.end - CLOSE;
}
