/**
 * Minimum and maximum of ever larger groups of samples: any part of a curve is drawn with one pair per pixel.
 */

/** @typedef {{step: number, low: Float32Array, high: Float32Array}} Level groups of `step` samples */

const GROUP = 4;

export class Pyramid {
  #levels;

  /** @param {Float32Array} values */
  constructor(values) {
    this.#levels = [{ step: 1, low: values, high: values }];
  }

  get length() {
    return this.#levels[0].low.length;
  }

  get values() {
    return this.#levels[0].low;
  }

  /**
   * Return minimum and maximum of samples [first, last), at least one.
   * @param {number} first @param {number} last @returns {[number, number]}
   */
  range(first, last) {
    const { step, low, high } = this.#level((last - first) / 2);
    const from = Math.max(0, Math.min(Math.floor(first / step), low.length - 1));
    const to = Math.min(low.length, Math.max(Math.ceil(last / step), from + 1));
    let [least, most] = [Infinity, -Infinity];
    for (let i = from; i < to; i++) {
      if (low[i] < least) least = low[i];
      if (high[i] > most) most = high[i];
    }
    return [least, most];
  }

  /** The coarsest level whose groups are at most `samples` long. @param {number} samples */
  #level(samples) {
    let k = 0;
    while (GROUP ** (k + 1) <= samples) k++;
    while (this.#levels.length <= k) this.#levels.push(coarser(this.#levels[this.#levels.length - 1]));
    return this.#levels[k];
  }
}

/** @param {Level} level @returns {Level} */
function coarser({ step, low, high }) {
  const count = Math.ceil(low.length / GROUP);
  const next = { step: step * GROUP, low: new Float32Array(count), high: new Float32Array(count) };
  for (let i = 0; i < count; i++) {
    let [least, most] = [Infinity, -Infinity];
    for (let k = i * GROUP; k < Math.min((i + 1) * GROUP, low.length); k++) {
      least = Math.min(least, low[k]);
      most = Math.max(most, high[k]);
    }
    next.low[i] = least;
    next.high[i] = most;
  }
  return next;
}
