import { h } from "./dom.js";

/**
 * The row of tools over the timeline.
 */

const STEP = 1.4; // zoom of a click

export class Tools {
  #desk;
  #remove;

  /**
   * @param {HTMLElement} parent @param {import("./desk.js").Desk} desk
   * @param {{add: () => void, blocks: () => void, graphs: Node}} parts
   */
  constructor(parent, desk, { add, blocks, graphs }) {
    this.#desk = desk;
    this.#remove = button("Delete", () => desk.remove(), { title: "Delete the selected movement or key (Delete)" });
    parent.append(h("div", { class: "tl-tools", role: "toolbar", "aria-label": "Timeline tools" },
      button("Add…", add, { title: "Add a movement at the playhead (N)" }),
      this.#remove, button("Movements", blocks, { title: "Go to the list of movements: arrows walk in it and shape them" }),
      graphs,
      toggle("Draw", (on) => (desk.draws = on), false, "Draw curves by hand on the graphs (D)", "tl-draw"),
      h("span", { class: "tl-gap" }),
      toggle("Snap", (on) => (desk.snaps = on), true, "Edits snap to the phones' edges; Alt does the opposite"),
      toggle("Follow", (on) => (desk.follows = on), true, "Keep the playhead in sight while it plays"),
      button("−", () => desk.zoom(1 / STEP), { "aria-label": "Zoom out", title: "Zoom out (Ctrl+wheel, −)" }),
      button("+", () => desk.zoom(STEP), { "aria-label": "Zoom in", title: "Zoom in (Ctrl+wheel, +)" }),
      button("Fit", () => desk.fit(), { title: "Show the whole take" }))); // prettier-ignore
  }

  /** Show what can be done now. */
  show() {
    const { selectedKey } = this.#desk.scene;
    this.#remove.disabled = !this.#desk.block?.editable && !selectedKey;
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
