import { curvesOf } from "../../player/take.js";

/**
 * Preview of edits in progress: the curves and the face at the playhead as they would be with these edits;
 * one request at a time, then the newest state.
 */
export class Preview {
  #actions;
  #changed;
  /** @type {import("../model/model.js").Model | null} */
  #model = null;
  /** @type {Record<string, any>[] | null} edits of the wire */
  #wanted = null;
  #busy = false;
  #standing;

  /**
   * @param {import("../../studio/actions.js").Actions} actions @param {() => void} changed
   * @param {() => number | null} standing time of the playhead; null while it runs
   */
  constructor(actions, changed, standing) {
    this.#actions = actions;
    this.#changed = changed;
    this.#standing = standing;
  }

  /** @param {import("../model/model.js").Model} model model whose curves are replaced */
  setModel(model) {
    this.#model = model;
  }

  /** Show the curves with some edits. @param {Record<string, any>[]} edits */
  show(edits) {
    if (edits.length === 0) this.end();
    else {
      this.#wanted = edits;
      this.#ask();
    }
  }

  /** Show the take's own curves again. */
  end() {
    this.#wanted = null;
    this.#put(new Map());
    this.#actions.endPreview();
  }

  async #ask() {
    if (this.#busy || this.#wanted === null) return;
    this.#busy = true;
    const asked = this.#wanted;
    const answer = await this.#actions.preview(asked, this.#standing());
    this.#busy = false;
    // Drop the answer if the edits have changed meanwhile.
    if (this.#wanted && answer?.take === this.#model?.take.take) this.#put(curvesOf(answer.curves));
    if (this.#wanted === asked) this.#wanted = null;
    this.#ask();
  }

  /** @param {Map<string, Float32Array | null>} curves */
  #put(curves) {
    if (!this.#model || (this.#model.previewed.size === 0 && curves.size === 0)) return;
    this.#model.previewed = curves;
    this.#changed();
  }
}
