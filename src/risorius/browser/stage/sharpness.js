/**
 * How fine pictures are drawn: as fine as the screen; coarser in motion while the machine is too slow for that. Where
 * edges are not smoothed otherwise, the picture at rest is another, which is finer (`Still`).
 */

const SLOW = 1000 / 24; // ms between pictures
const FAST = 1000 / 50;
// From what a quick machine draws to what the slowest does: pixels, and whether all triangles.
const STEPS = [
  { ratio: 1, fine: true },
  { ratio: 1, fine: false },
  { ratio: 0.75, fine: false },
  { ratio: 0.5, fine: false },
];
const WAITS = 2; // pictures a hand has waited for until those after them are a step coarser
const PATIENCE = 5; // pictures in a row that must be slow before it is changed; ten times as many fast ones
const MOST = 2e6; // pixels of a picture at rest that is finer than the screen
const FINER = 2; // pixels of it to one of CSS
const REST = 800; // ms in which nobody moves anything after which the head is at rest

export class Sharpness {
  #step = 0;
  #strikes = 0;
  #waits = 0;
  #last = 0;
  #timer = 0;
  #atRest = false;
  #playing = false;
  #held = false;
  #rough;
  #rested;

  /**
   * @param {boolean} rough whether edges are not smoothed
   * @param {() => void} rested called when the head has come to rest: a finer picture is due
   */
  constructor(rough, rested) {
    this.#rough = rough;
    this.#step = rough ? 2 : 0;
    this.#rested = rested;
    for (const name of ["pointerdown", "pointerup", "pointercancel"]) {
      document.addEventListener(name, () => this.#hold(name === "pointerdown"), true);
    }
    // Who writes would wait for it, too.
    document.addEventListener("keydown", () => this.#atRest || this.moves(), true);
  }

  /** Pixels drawn per CSS pixel of a side. */
  get ratio() {
    return this.fine ? screenRatio() : this.#now.ratio * screenRatio();
  }

  /** The same in the picture at rest. @param {number} area of it, in CSS pixels */
  stillRatio(area) {
    return Math.max(Math.min(FINER, Math.sqrt(MOST / area)), screenRatio());
  }

  /** Whether all triangles are drawn. */
  get fine() {
    return (this.#atRest && !this.#rough) || this.#now.fine;
  }

  get #now() {
    return STEPS[Math.min(this.#step + (this.#waits < WAITS ? 0 : 1), STEPS.length - 1)];
  }

  /** Whether it plays, or is about to: then it is never at rest, however slowly pictures come. @param {boolean} playing */
  set playing(playing) {
    if (playing === this.#playing) return;
    this.#playing = playing;
    this.#waits = 0;
    this.moves();
  }

  /** Something moves, or is about to. */
  moves() {
    this.#atRest = false;
    clearTimeout(this.#timer);
    if (!this.#playing && !this.#held) this.#timer = setTimeout(() => this.#rest(), REST);
  }

  /** Take note that a picture was drawn now. */
  drew() {
    const now = performance.now();
    const since = now - this.#last;
    this.#last = now;
    if (this.#atRest || (since > REST && !this.#playing)) this.#strikes = 0;
    else this.#judge(since > SLOW ? 1 : since < FAST ? -0.1 : 0);
  }

  /** A picture was asked for before the last one was there: until the line plays again they come sooner. */
  kept() {
    this.#waits += 1;
  }

  /** A hand that holds something is about to move it: a fine picture would keep it waiting. @param {boolean} held */
  #hold(held) {
    this.#held = held;
    if (held) clearTimeout(this.#timer);
    else if (!this.#atRest) this.moves();
  }

  #rest() {
    this.#atRest = true;
    this.#rested();
  }

  /** @param {number} strike */
  #judge(strike) {
    this.#strikes = Math.sign(this.#strikes) === Math.sign(strike) ? this.#strikes + strike : strike;
    if (Math.abs(this.#strikes) < PATIENCE) return;
    this.#step = Math.min(Math.max(this.#step + Math.sign(strike), 0), STEPS.length - 1);
    this.#strikes = 0;
  }
}

function screenRatio() {
  return Math.min(window.devicePixelRatio, 2);
}
