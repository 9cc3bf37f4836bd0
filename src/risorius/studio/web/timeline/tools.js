import { h } from "./dom.js";

/**
 * The row of tools over the timeline.
 */

const STEP = 1.4; // zoom of a click

export class Tools {
  #controller;
  #remove;

  /**
   * @param {HTMLElement} parent @param {import("./controller.js").TimelineController} controller
   * @param {{add: () => void, blocks: () => void, graphs: Node}} parts
   */
  constructor(parent, controller, { add, blocks, graphs }) {
    this.#controller = controller;
    this.#remove = button("Delete", () => controller.remove(), { title: "Delete the selected movement or key (Delete)" });
    parent.append(h("div", { class: "tl-tools", role: "toolbar", "aria-label": "Timeline tools" },
      button("Add…", add, { title: "Add a movement at the playhead (N)" }),
      this.#remove, button("Movements", blocks, { title: "Go to the list of movements; arrow keys select and edit them" }),
      graphs,
      toggle("Draw", (on) => (controller.draws = on), false, "Draw curves by hand on the graphs (D)", "tl-draw"),
      h("span", { class: "tl-gap" }),
      toggle("Snap", (on) => (controller.snaps = on), true, "Edits snap to the phones' edges; Alt does the opposite"),
      toggle("Follow", (on) => (controller.follows = on), true, "Keep the playhead visible while it plays"),
      button("−", () => controller.zoom(1 / STEP), { "aria-label": "Zoom out", title: "Zoom out (Ctrl+wheel, −)" }),
      button("+", () => controller.zoom(STEP), { "aria-label": "Zoom in", title: "Zoom in (Ctrl+wheel, +)" }),
      button("Fit", () => controller.fit(), { title: "Show the whole take" }))); // prettier-ignore
  }

  /** Show what can be done now. */
  show() {
    const { selectedKey } = this.#controller.scene;
    this.#remove.disabled = !this.#controller.block?.editable && !selectedKey;
  }
}

function button(text, onclick, given = {}) {
  return h("button", { type: "button", onclick, ...given }, text);
}

function toggle(text, set, on, title, id = null) {
  const made = button(text, () => turn(!(made.getAttribute("aria-pressed") === "true")), { title, id });
  const turn = (pressed) => {
    made.setAttribute("aria-pressed", String(pressed));
    set(pressed);
  };
  turn(on);
  return made;
}
