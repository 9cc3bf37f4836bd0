import { clipboard } from "../edit/clipboard.js";
import { h } from "../dom.js";
/** @import {Attributes} from "../../types.js" */

/**
 * The row of tools over the timeline.
 */

const STEP = 1.4; // zoom of a click

export class Tools {
  #controller;
  #remove;
  #copy;
  #paste;

  /**
   * @param {HTMLElement} parent @param {import("../controller.js").TimelineController} controller
   * @param {{add: () => void, blocks: () => void, markers: () => void, graphs: Node}} parts
   */
  constructor(parent, controller, { add, blocks, graphs, markers }) {
    this.#controller = controller;
    this.#copy = button("Copy", () => controller.copy().then(() => this.show()), { title: "Copy the selected movements (Ctrl C)" });
    this.#paste = button("Paste", () => controller.paste(), { title: "Paste the copied movements at the playhead (Ctrl V)" });
    this.#remove = button("Delete", () => controller.remove(), { title: "Delete the selected movement or key (Delete)" });
    parent.append(h("div", { class: "tl-tools", role: "toolbar", "aria-label": "Timeline tools" },
      button("Add…", add, { title: "Add a movement at the playhead (N)" }),
      this.#remove, this.#copy, this.#paste, button("Movements", blocks, { title: "Go to the list of movements; arrow keys select and edit them" }),
      button("Markers…", markers, { title: "List the markers; M sets one at the playhead, < and > go to the previous and next" }),
      graphs,
      toggle("Draw", (on) => (controller.draws = on), false, "Draw curves by hand on the graphs (D)", "tl-draw"),
      h("span", { class: "tl-gap" }),
      toggle("Snap", (on) => (controller.snaps = on), true, "Snap edits to phone boundaries; hold Alt for the opposite"),
      toggle("Follow", (on) => (controller.follows = on), true, "Keep the playhead visible during playback"),
      button("−", () => controller.zoom(1 / STEP), { "aria-label": "Zoom out", title: "Zoom out (Ctrl+wheel, −)" }),
      button("+", () => controller.zoom(STEP), { "aria-label": "Zoom in", title: "Zoom in (Ctrl+wheel, +)" }),
      button("Fit", () => controller.fit(), { title: "Show the whole take" }))); // prettier-ignore
  }

  /** Enable the buttons that apply now. */
  show() {
    const { selectedKey } = this.#controller.scene;
    this.#copy.disabled = !this.#controller.blocks.some(({ editable }) => editable);
    this.#paste.disabled = clipboard().length === 0;
    this.#remove.disabled = !this.#controller.block?.free && !selectedKey;
  }
}

/** @param {string} text @param {() => void} onclick @param {Attributes} [given] */
function button(text, onclick, given = {}) {
  return h("button", { type: "button", onclick, ...given }, text);
}

/**
 * @param {string} text @param {(on: boolean) => void} set @param {boolean} on @param {string} title
 * @param {string | null} [id]
 */
function toggle(text, set, on, title, id = null) {
  const made = button(text, () => turn(!(made.getAttribute("aria-pressed") === "true")), { title, id });
  /** @param {boolean} pressed */
  const turn = (pressed) => {
    made.setAttribute("aria-pressed", String(pressed));
    set(pressed);
  };
  turn(on);
  return made;
}
