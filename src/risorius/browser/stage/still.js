/** The fine picture of heads at rest, where no graphics card draws. It is shown when it is whole. */
export class Still {
  #fine;
  #overlay;
  #job = 0;
  #shown = false;

  /** @param {import("./fine.js").Fine} fine makes the picture @param {import("./overlay.js").Overlay} overlay shows it */
  constructor(fine, overlay) {
    this.#fine = fine;
    this.#overlay = overlay;
  }

  /** Whether it is what is seen. */
  get shown() {
    return this.#shown;
  }

  /** Give up what is being made. */
  stop() {
    this.#job += 1;
  }

  /** Something moves: what was made is not what is to be seen. */
  leave() {
    this.stop();
    this.#shown = false;
  }

  /**
   * Make the picture, unless it is given up, and show it.
   * @param {import("./fine.js").Seen} seen @returns {Promise<boolean>} whether it is shown
   */
  async make(seen) {
    const job = ++this.#job;
    const picture = await this.#fine.picture(seen, () => job === this.#job);
    if (!picture) return false;
    this.#overlay.show(picture);
    this.#shown = true;
    return true;
  }
}
