/**
 * Pictures of a line's frames, as fine as that of the head at rest, where no graphics card draws: made one by one while
 * nobody does anything, and shown in step with the sound.
 */

const IDLE = 2000; // ms in which nobody does anything after which they are made
const AGAIN = 500; // ms after which a face that has not come is asked for again
const MOST = 900; // pictures: about 50 MB
const AHEAD = 8; // pictures that are decoded before they are due
const ENOUGH = 60; // pictures ahead with which playing may begin: fewer would soon give way to coarse ones
const QUALITY = 0.92;
const KEY = "risorius-fine-preview";

/**
 * @typedef {{frames: number, now: number, face: (frame: number) => Promise<import("./faces.js").Face | null>}} Line
 * the take, the frame at the playhead, and its faces; null where one cannot be had now
 */

export class Baked {
  #fine;
  #overlay;
  #stage;
  #pictures = new Map(); // by frame: a Blob
  #decoded = new Map(); // by frame: an ImageBitmap; null while it is decoded
  #job = 0;
  /** @type {import("./figure.js").Figure | null} */
  #lender = null;
  #timer = 0;
  #due = -1;
  #calls = new Set();
  #on = localStorage.getItem(KEY) !== "off";

  /**
   * @param {import("./fine.js").Fine} fine @param {import("./overlay.js").Overlay} overlay
   * @param {{line: () => Line | null, seen: () => import("./fine.js").Seen | null}} stage what there is to make now
   */
  constructor(fine, overlay, stage) {
    this.#fine = fine;
    this.#overlay = overlay;
    this.#stage = stage;
    for (const name of ["keydown", "pointerdown", "wheel"]) {
      document.addEventListener(name, () => this.#engaged && this.later(), { capture: true, passive: true });
    }
  }

  /** Whether they are made. */
  get on() {
    return this.#on;
  }

  set on(on) {
    this.#on = on;
    localStorage.setItem(KEY, on ? "on" : "off");
    if (on) this.later();
    else this.stop();
    this.#tell();
  }

  /** @param {() => void} call told when there are more or fewer pictures @returns {() => void} ends it */
  watch(call) {
    this.#calls.add(call);
    return () => this.#calls.delete(call);
  }

  /** The share of the line that is made, 0 to 1; null where none is being made. */
  get share() {
    const line = this.#making ? this.#stage.line() : null;
    return line && this.#pictures.size / Math.min(line.frames, MOST);
  }

  /** Forget the pictures of frames [first, last): their faces are others. */
  forget(first = 0, last = Infinity) {
    this.stop();
    for (const frame of [...this.#pictures.keys()]) {
      if (frame < first || frame >= last) continue;
      this.#pictures.delete(frame);
      this.#drop(frame);
    }
    this.#due = -1;
    this.#tell();
  }

  /** Whether playing from a frame on would show enough of them. @param {number} frame */
  lasts(frame) {
    const { frames } = this.#stage.line() ?? { frames: 0 };
    const last = Math.min(frame + ENOUGH, frames);
    for (let k = frame; k < last; k++) if (this.#near(k) === null) return false;
    return last > frame;
  }

  /**
   * Show the picture of a frame, or, as long as it is decoded, what was shown before.
   * @param {number} frame @returns {boolean} whether there is one
   */
  show(frame) {
    const near = this.#near(frame);
    this.#due = near ?? -1;
    if (near === null) return false;
    this.#decode(near);
    const picture = this.#decoded.get(near);
    if (picture) this.#overlay.show(picture);
    return Boolean(picture) || this.#overlay.shown;
  }

  /** Somebody does something: go on when nobody has for a while. */
  later() {
    this.stop();
    if (this.#on) this.#wait(IDLE);
  }

  /** Make no more, until `later`. */
  stop() {
    clearTimeout(this.#timer);
    this.#timer = 0;
    this.#job += 1;
    this.#lender?.lend(null);
    if (this.#lender) this.#tell();
    this.#lender = null;
  }

  /** What is shown is not of them any more. */
  leave() {
    this.#due = -1;
  }

  get #making() {
    return this.#lender !== null;
  }

  get #engaged() {
    return this.#making || this.#timer !== 0;
  }

  /** @param {number} time */
  #wait(time) {
    this.#timer = setTimeout(() => {
      this.#timer = 0;
      this.#make();
    }, time);
  }

  async #make() {
    const [line, seen, job] = [this.#stage.line(), this.#stage.seen(), ++this.#job];
    if (!line || !seen || document.hidden) return;
    const [{ figure }] = seen.places;
    for (const frame of order(line, MOST)) {
      if (this.#pictures.has(frame)) continue;
      const face = await line.face(frame);
      if (job !== this.#job) return;
      if (!face) {
        this.#wait(AGAIN);
        break;
      }
      this.#lender = figure;
      figure.lend(face);
      const wanted = () => job === this.#job && figure.lent === face;
      const picture = await this.#fine.picture(seen, wanted);
      const blob = picture && (await blobOf(picture));
      if (job !== this.#job) return;
      if (blob) this.#pictures.set(frame, blob);
      this.#tell();
    }
    this.#lender?.lend(null);
    this.#lender = null;
    this.#decode(line.now);
    this.#tell();
  }

  /** The frame whose picture is shown at a frame: every second one is made first. @param {number} frame */
  #near(frame) {
    return [frame, frame - 1].find((one) => this.#pictures.has(one)) ?? null;
  }

  /** Have the pictures of the next frames ready. @param {number} frame */
  #decode(frame) {
    for (const other of this.#decoded.keys()) if (other < frame || other > frame + AHEAD) this.#drop(other);
    for (let k = frame; k <= frame + AHEAD; k++) {
      const blob = this.#pictures.get(k);
      if (!blob || this.#decoded.has(k)) continue;
      this.#decoded.set(k, null);
      createImageBitmap(blob).then((picture) => {
        if (this.#decoded.get(k) !== null || this.#pictures.get(k) !== blob) return;
        this.#decoded.set(k, picture);
        if (this.#due === k) this.#overlay.show(picture);
      });
    }
  }

  /** @param {number} frame */
  #drop(frame) {
    this.#decoded.get(frame)?.close();
    this.#decoded.delete(frame);
  }

  #tell() {
    for (const call of [...this.#calls]) call();
  }
}

/**
 * The frames in the order in which they are made: every second one from the playhead on, then those between.
 * @param {Line} line @param {number} most
 */
function order({ frames, now }, most) {
  const around = Array.from({ length: frames }, (_, k) => (now + k) % frames).slice(0, most);
  /** @param {number} frame */
  const even = (frame) => frame % 2 === 0;
  return [...around.filter(even), ...around.filter((frame) => !even(frame))];
}

/** @param {ImageData} picture */
function blobOf(picture) {
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  canvas.getContext("2d", { willReadFrequently: true })?.putImageData(picture, 0, 0);
  return canvas.convertToBlob({ type: "image/jpeg", quality: QUALITY });
}
