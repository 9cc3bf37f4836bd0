/**
 * The outline of a movement: it rises by its onset function, holds, and falls by the function's mirror image.
 */

/** @import {Catalogue} from "../../wire.js" */

const STRAIGHT = [0, 1];

/** The onset functions of the catalogue as lists of values at even steps from 0 to 1. */
export class Shapes {
  #samples;

  /** @param {Catalogue} catalogue */
  constructor(catalogue) {
    this.#samples = new Map(catalogue.onset_functions.map(({ name, samples }) => [name, samples]));
  }

  /**
   * Trace a block's outline from the bottom left to the bottom right.
   * @param {CanvasRenderingContext2D} context
   * @param {{function: string}} block
   * @param {number[]} xs pixels: start, end of onset, start of offset, end
   * @param {number} top @param {number} bottom
   */
  trace(context, block, [start, rise, fall, end], top, bottom) {
    const samples = this.#samples.get(block.function) ?? STRAIGHT;
    context.moveTo(start, bottom);
    this.#ramp(context, samples, start, rise, top, bottom);
    context.lineTo(fall, top);
    this.#ramp(context, samples, end, fall, top, bottom, true);
  }

  /**
   * A ramp between the bottom at `foot` and the top at `peak`; drawn downwards where `falling`.
   * @param {CanvasRenderingContext2D} context @param {number[]} samples @param {number} foot @param {number} peak
   * @param {number} top @param {number} bottom
   */
  #ramp(context, samples, foot, peak, top, bottom, falling = false) {
    const last = samples.length - 1;
    const pixels = Math.abs(peak - foot);
    const step = Math.max(1, Math.floor((2 * last) / Math.max(pixels, 1)));
    /** @param {number} k */
    const point = (k) => {
      context.lineTo(foot + ((peak - foot) * k) / last, bottom + (top - bottom) * samples[k]);
    };
    if (falling) for (let k = last; k > 0; k -= step) point(k);
    else for (let k = 0; k < last; k += step) point(k);
    point(falling ? 0 : last);
  }
}
