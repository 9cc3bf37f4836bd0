/** The number of pixels drawn: fewer while drawing is too slow, all when nothing moves. */

const SLOW = 1000 / 24; // ms between pictures
const FAST = 1000 / 50;
const STEPS = [1, 0.75, 0.5]; // of the screen's pixels a side
const PATIENCE = 5; // slow pictures in a row before the ratio drops; ten times as many fast ones before it rises
const PAUSE = 800; // ms without a picture after which the next one is not slow

export class PixelRatio {
  #step = 0;
  #strikes = 0;
  #last = -Infinity;

  /** The share of the screen's pixels a side that is drawn in motion. */
  get share() {
    return STEPS[this.#step];
  }

  /** A picture was drawn. @param {number} now ms */
  drew(now) {
    const since = now - this.#last;
    this.#last = now;
    if (since > PAUSE) this.#strikes = 0;
    else this.#judge(since > SLOW ? 1 : since < FAST ? -0.1 : 0);
  }

  /** @param {number} strike */
  #judge(strike) {
    this.#strikes = Math.sign(this.#strikes) === Math.sign(strike) ? this.#strikes + strike : strike;
    if (Math.abs(this.#strikes) < PATIENCE) return;
    this.#step = Math.min(Math.max(this.#step + Math.sign(strike), 0), STEPS.length - 1);
    this.#strikes = 0;
  }
}
