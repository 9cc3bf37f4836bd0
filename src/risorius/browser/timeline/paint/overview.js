import { graphics } from "../../stage/graphics.js";
import { contextOf } from "../../parts/dom.js";
import { h } from "../dom.js";

/**
 * The whole take in one strip, with its sound and the visible part; dragging scrolls.
 */

const PART = 0.2; // share of the visible part by which an arrow key scrolls

export class Overview {
  #canvas = h("canvas");
  #thumb = h("div", { class: "tl-thumb" });
  #box;
  #controller;
  #drawn = "";

  /** @param {HTMLElement} parent @param {import("../controller.js").TimelineController} controller */
  constructor(parent, controller) {
    this.#controller = controller;
    this.#box = h("div", {
      class: "tl-overview", role: "scrollbar", tabindex: "0", "aria-label": "Visible part of the take",
      "aria-orientation": "horizontal", "aria-valuemin": "0", "aria-controls": "tl-canvas",
    }, this.#canvas, this.#thumb); // prettier-ignore
    this.#box.addEventListener("pointerdown", (event) => this.#down(event));
    this.#box.addEventListener("pointermove", (event) => this.#box.hasPointerCapture(event.pointerId) && this.#to(event));
    this.#box.addEventListener("keydown", (event) => this.#key(event));
    parent.append(this.#box);
  }

  /** @param {PointerEvent} event */
  #down(event) {
    this.#box.setPointerCapture(event.pointerId);
    this.#to(event);
  }

  /** @param {PointerEvent} event */
  #to({ clientX }) {
    const { left, width } = this.#box.getBoundingClientRect();
    const { view } = this.#controller.scene;
    view.scrollTo(((clientX - left) / width) * view.duration - view.span / 2);
    this.#controller.repaint();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const { view } = this.#controller.scene;
    /** @type {Record<string, number>} */
    const ways = { ArrowLeft: -PART, ArrowRight: PART, PageUp: -1, PageDown: 1, Home: -Infinity, End: Infinity };
    if (!(event.key in ways)) return;
    event.preventDefault();
    event.stopPropagation();
    const way = ways[event.key];
    view.scrollTo(Number.isFinite(way) ? view.start + way * view.span : way < 0 ? 0 : view.duration);
    this.#controller.repaint();
  }

  /** Show the visible part. */
  show() {
    const { view, model } = this.#controller.scene;
    if (!model) return;
    /** @param {number} time */
    const share = (time) => Math.max(0, Math.min(1, time / view.duration));
    this.#thumb.style.left = `${100 * share(view.start)}%`;
    this.#thumb.style.width = `${100 * (share(view.end) - share(view.start))}%`;
    this.#box.setAttribute("aria-valuemax", view.duration.toFixed(2));
    this.#box.setAttribute("aria-valuenow", Math.max(0, view.start).toFixed(2));
    this.#box.setAttribute("aria-valuetext", `${Math.max(0, view.start).toFixed(1)} to ${view.end.toFixed(1)} seconds`);
    this.#paint();
  }

  /** The sound's outline; redrawn only for another take, size or theme. */
  #paint() {
    const { model, palette } = this.#controller.scene;
    const { clientWidth: width, clientHeight: height } = this.#box;
    const wave = model.speech?.waves[0];
    const drawn = `${model.take.take} ${width} ${height} ${palette.wave}`;
    if (drawn === this.#drawn) return;
    this.#drawn = drawn;
    [this.#canvas.width, this.#canvas.height] = [width, height];
    const context = contextOf(this.#canvas, { willReadFrequently: graphics() !== "card" });
    context.fillStyle = palette.wave;
    const peaks = wave?.peaks ?? new Int8Array();
    const count = peaks.length / 2;
    for (let x = 0; x < width && count; x++) {
      let most = 0;
      const last = Math.max(Math.floor((x * count) / width) + 1, Math.ceil(((x + 1) * count) / width));
      for (let k = Math.floor((x * count) / width); k < Math.min(last, count); k++) {
        most = Math.max(most, -peaks[2 * k], peaks[2 * k + 1]);
      }
      const tall = (most / 128) * height;
      context.fillRect(x, (height - tall) / 2, 1, tall);
    }
  }
}
