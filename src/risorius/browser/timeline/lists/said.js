import { h } from "../dom.js";
import { textOf } from "../paint/paint_head.js";

/** @type {("words" | "phones")[]} */
const KINDS = ["words", "phones"];

/**
 * Marks the current word and phone, in elements over the canvas, so that the canvas is not redrawn for them:
 * without a graphics card, that takes longer than drawing the face.
 */
export class Said {
  #marks = Object.fromEntries(KINDS.map((kind) => [kind, h("div", { class: "tl-said", hidden: "" })]));
  /** @type {Record<string, string>} where the marks are, by kind */
  #shown = {};
  #scene;

  /** @param {HTMLElement} frame the canvas' own @param {import("../paint/scene.js").Scene} scene */
  constructor(frame, scene) {
    this.#scene = scene;
    frame.append(...Object.values(this.#marks));
  }

  /** Mark the word and phone at the scene's time, if they are visible. */
  show() {
    for (const kind of KINDS) this.#place(kind, this.#box(kind));
  }

  /** @param {"words" | "phones"} kind @returns {number[] | null} left, top, width and height in the page's pixels */
  #box(kind) {
    const { model, head, view, unit, time } = this.#scene;
    const item = model?.speech?.[kind].at(time);
    const row = head.find((one) => one.kind === kind);
    if (!row || !item || !(textOf(item))) return null;
    const [left, right] = [Math.max(view.x(item.start), 0), Math.min(view.x(item.end), view.width)];
    return left < right ? [left, row.y + 1, right - left, row.height - 2].map((length) => length * unit) : null;
  }

  /** @param {string} kind @param {number[] | null} box */
  #place(kind, box) {
    const key = String(box);
    if (this.#shown[kind] === key) return;
    this.#shown[kind] = key;
    const mark = this.#marks[kind];
    mark.hidden = box === null;
    if (box === null) return;
    [mark.style.left, mark.style.top, mark.style.width, mark.style.height] = box.map((length) => `${length}px`);
  }
}
