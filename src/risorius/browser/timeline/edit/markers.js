import { beginning, clockTime } from "../paint/paint_head.js";
import { foundIn, h } from "../dom.js";
/** @import {SpeechRow} from "../../types.js" */
/** @import {Marker} from "../../wire.js" */
/** @import {TimelineController} from "../controller.js" */
/** @import {Scene} from "../paint/scene.js" */

/**
 * Markers: times with a note, as flags on the ruler and as an editable list.
 */

const NEAR = 6; // pixels
const WIDEST = 140; // pixels of a note on the ruler

/**
 * Return the index of the marker at a place on the ruler, or -1.
 * @param {Scene} scene @param {SpeechRow | null} row @param {number} x
 */
export function markerNear({ model, view }, row, x) {
  if (row?.kind !== "ruler") return -1;
  return model.markers.findLastIndex(({ time }) => Math.abs(view.x(time) - x) <= NEAR);
}

/** @param {import("../paint/scene.js").Scene} scene @param {{y: number, height: number}} row the ruler's */
export function paintMarkers({ context, view, palette, model, width, height }, row) {
  context.font = `10px ${palette.font}`;
  context.textAlign = "left";
  context.textBaseline = "middle";
  model.markers.forEach(({ time, text }, k) => {
    const x = Math.round(view.x(time));
    if (x < -WIDEST || x > width) return;
    const next = model.markers[k + 1];
    const room = Math.min(next ? view.x(next.time) - x : WIDEST, WIDEST) - 8;
    const label = beginning(context, text, room);
    const wide = label ? context.measureText(label).width + 7 : 5;
    context.fillStyle = palette.tone;
    context.fillRect(x, row.y, wide, 12);
    context.globalAlpha = 0.5;
    context.fillRect(x, row.y, 1, height);
    context.globalAlpha = 1;
    context.fillStyle = palette.ground;
    context.fillText(label, x + 4, row.y + 6.5);
  });
}

/** Drag a marker; a click goes to its time. */
export class DragMarker {
  #controller;
  #index;
  #x;
  #from;
  /** @type {number | null} */
  #time = null;

  /** @param {TimelineController} controller @param {number} x @param {number} index */
  constructor(controller, x, index) {
    this.#controller = controller;
    this.#index = index;
    this.#x = x;
    this.#from = controller.scene.model.markers[index].time;
    controller.clock.seek(this.#from);
  }

  /** @param {number} x */
  move(x) {
    if (this.#time === null && Math.abs(x - this.#x) < 3) return;
    const { scene } = this.#controller;
    this.#time = Math.max(0, Math.min(this.#from + (x - this.#x) / scene.view.scale, scene.model.duration));
    scene.guide = this.#time;
    this.#controller.repaint();
  }

  async end() {
    const { markers } = this.#controller.scene.model;
    if (this.#time !== null) {
      const time = this.#time;
      await this.#controller.setMarkers(markers.map((marker, k) => (k === this.#index ? { ...marker, time } : marker)));
    }
    this.cancel();
  }

  cancel() {
    this.#controller.scene.guide = null;
    this.#controller.repaint();
  }
}

/** The list of all markers, to edit, go to and delete them. */
export class MarkerList {
  #controller;
  #rows = h("div", { class: "stack" });
  #dialog;

  /** @param {HTMLElement} parent @param {import("../controller.js").TimelineController} controller */
  constructor(parent, controller) {
    this.#controller = controller;
    const add = h("button", { id: "tl-marker-add", onclick: () => this.#add() }, "Set a marker at the playhead");
    const close = h("button", { class: "primary", onclick: () => this.#dialog.close() }, "Close");
    this.#dialog = h("dialog", { class: "tl-markers", "aria-labelledby": "tl-markers-title" },
      h("h2", { id: "tl-markers-title" }, "Markers"), this.#rows, h("div", { class: "row" }, add, close)); // prettier-ignore
    this.#dialog.addEventListener("keydown", (event) => event.stopPropagation());
    parent.append(this.#dialog);
  }

  /** @param {number} [index] the marker whose note gets the focus */
  open(index = 0) {
    if (!this.#controller.scene.model) return;
    this.#show();
    this.#dialog.showModal();
    foundIn(this.#dialog, `#tl-marker-${index}-text`)?.focus();
  }

  #show() {
    const { markers } = this.#controller.scene.model;
    const none = h("p", { class: "hint" }, "No markers yet. Press M to set one at the playhead.");
    this.#rows.replaceChildren(...(markers.length ? markers.map((marker, k) => this.#row(marker, k)) : [none]));
  }

  /** @param {Marker} marker @param {number} k */
  #row({ time, text }, k) {
    const what = `marker ${k + 1}`;
    const { duration } = this.#controller.scene.model;
    const at = h("input", { type: "number", id: `tl-marker-${k}-time`, min: 0, max: duration, step: "any", "aria-label": `Time of ${what}, seconds` });
    at.value = String(Number(time.toFixed(3)));
    const note = h("input", { type: "text", id: `tl-marker-${k}-text`, maxlength: 120, placeholder: "Note", "aria-label": `Note of ${what}` });
    note.value = text ?? "";
    const change = () => at.checkValidity() && this.#change(k, { time: Number(at.value), text: note.value });
    for (const input of [at, note]) input.addEventListener("change", change);
    const go = h("button", { title: clockTime(time), onclick: () => this.#controller.clock.seek(time), "aria-label": `Go to ${what}` }, "Go");
    const away = h("button", { "aria-label": `Delete ${what}`, title: "Delete", onclick: () => this.#change(k, null) }, "×");
    return h("div", { class: "tl-marker" }, at, note, go, away);
  }

  /** @param {number} index @param {Marker | null} marker */
  async #change(index, marker) {
    const rest = this.#controller.scene.model.markers.map((one, k) => (k === index ? marker : one));
    await this.#controller.setMarkers(rest.filter((one) => one !== null));
    const focus = document.activeElement?.id;
    this.#show();
    if (focus) foundIn(this.#dialog, `#${CSS.escape(focus)}`)?.focus();
  }

  async #add() {
    const index = await this.#controller.addMarker();
    this.#show();
    foundIn(this.#dialog, `#tl-marker-${index}-text`)?.focus();
  }
}
