/** A picture that lies over the stage's own canvas: what is finer than the stage draws in time. */
export class Overlay {
  #canvas = document.createElement("canvas");
  #context;

  /** @param {HTMLCanvasElement} below */
  constructor(below) {
    this.#canvas.className = "still";
    this.#canvas.hidden = true;
    this.#canvas.setAttribute("aria-hidden", "true");
    this.#context = /** @type {CanvasRenderingContext2D} */ (
      this.#canvas.getContext("2d", { alpha: false, willReadFrequently: true })
    );
    below.after(this.#canvas);
  }

  /** Whether it is shown. */
  get shown() {
    return !this.#canvas.hidden;
  }

  /** @param {ImageData | ImageBitmap} picture */
  show(picture) {
    const { width, height } = picture;
    // To set a size clears, even the same one.
    if (this.#canvas.width !== width || this.#canvas.height !== height) Object.assign(this.#canvas, { width, height });
    if (picture instanceof ImageData) this.#context.putImageData(picture, 0, 0);
    else this.#context.drawImage(picture, 0, 0);
    this.#canvas.hidden = false;
  }

  hide() {
    this.#canvas.hidden = true;
  }
}
