/** How fine pictures are drawn: as fine as the screen, or coarser while the machine is too slow for that. */

const SLOW = 1000 / 24; // ms between pictures
const FAST = 1000 / 50;
const STEPS = [1, 0.8, 0.65, 0.5];
const PATIENCE = 6; // pictures in a row that must be slow, or fast, before it is changed
const REST = 300; // ms without a picture after which the next one stands alone

export class Sharpness {
  #step = 0;
  #strikes = 0;
  #last = 0;
  #changed;

  /** @param {() => void} changed called when the ratio is another */
  constructor(changed) {
    this.#changed = changed;
  }

  /** Pixels drawn per CSS pixel. */
  get ratio() {
    return STEPS[this.#step] * Math.min(window.devicePixelRatio, 2);
  }

  /** Take note that a picture was drawn now. */
  drew() {
    const now = performance.now();
    const since = now - this.#last;
    this.#last = now;
    if (since > REST) {
      this.#strikes = 0;
      return;
    }
    const way = since > SLOW ? 1 : since < FAST ? -1 : 0;
    this.#strikes = Math.sign(this.#strikes) === way ? this.#strikes + way : way;
    if (Math.abs(this.#strikes) < PATIENCE * (way < 0 ? 10 : 1)) return;
    this.#strikes = 0;
    const step = Math.min(Math.max(this.#step + way, 0), STEPS.length - 1);
    if (step === this.#step) return;
    this.#step = step;
    this.#changed();
  }
}
