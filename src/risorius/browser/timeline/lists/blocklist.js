import { foundIn, h, spoken } from "../dom.js";
import { timesOf } from "../model/times.js";
/** @import {Block} from "../../types.js" */
/** @import {TimelineController} from "../controller.js" */
/** @import {Model} from "../model/model.js" */

/**
 * The blocks as a list for the keyboard and for screen readers: one option has the focus, and only options near it exist.
 *
 * The list is invisible; the canvas draws a strong frame around the block whose option has the focus.
 */

const AROUND = 12; // options on either side of the one in focus

export class BlockList {
  #list = h("div", { role: "listbox", class: "unseen tl-blocks", "aria-label": "Movements", tabindex: "-1" });
  #said = h("p", { class: "unseen", role: "status" });
  #controller;
  /** @type {Block[]} as they are listed */
  #order = [];
  #current = 0;

  /** @param {HTMLElement} parent @param {import("../controller.js").TimelineController} controller */
  constructor(parent, controller) {
    this.#controller = controller;
    this.#list.addEventListener("keydown", (event) => this.#key(event));
    this.#list.addEventListener("focusin", () => this.#focused(true));
    this.#list.addEventListener("focusout", () => this.#focused(false));
    parent.append(this.#list, this.#said);
  }

  /** Switch to another model. @param {Model | null} model */
  setModel(model) {
    const id = this.#order[this.#current]?.id;
    this.#order = model ? model.lanes.flatMap(({ spans }) => spans.items) : [];
    const there = this.#order.findIndex((block) => block.id === id);
    this.#current = there >= 0 ? there : Math.max(0, Math.min(this.#current, this.#order.length - 1));
    this.#show();
  }

  /** Make the selected block the one in focus. @param {string | null} id */
  setSelected(id) {
    const there = this.#order.findIndex((block) => block.id === id);
    if (there < 0 || there === this.#current) return;
    this.#current = there;
    this.#show();
  }

  focus() {
    foundIn(this.#list, '[tabindex="0"]')?.focus({ preventScroll: true });
  }

  get #hasFocus() {
    return this.#list.contains(document.activeElement);
  }

  /** @param {boolean} there */
  #focused(there) {
    const { scene } = this.#controller;
    scene.focused = there;
    if (there && this.#order[this.#current] && scene.selected === null) this.#controller.choose(this.#order[this.#current]);
    if (!there) this.#controller.settle();
    this.#controller.repaint();
  }

  #show() {
    const had = this.#hasFocus;
    const from = Math.max(0, this.#current - AROUND);
    const near = this.#order.slice(from, this.#current + AROUND + 1);
    this.#list.replaceChildren(...near.map((block, k) => this.#option(block, from + k)));
    if (had) this.focus();
  }

  /** @param {Block} block @param {number} index */
  #option(block, index) {
    const current = index === this.#current;
    return h("div", {
      role: "option",
      id: `tl-block-${index}`,
      "data-id": block.id,
      tabindex: current ? "0" : "-1",
      "aria-selected": String(current),
      "aria-posinset": index + 1,
      "aria-setsize": this.#order.length,
    }, described(block, this.#controller)); // prettier-ignore
  }

  /** @param {number} index */
  #go(index) {
    if (this.#order.length === 0) return;
    this.#controller.settle();
    this.#current = Math.max(0, Math.min(index, this.#order.length - 1));
    const block = this.#order[this.#current];
    this.#show();
    this.#controller.choose(block);
    this.#controller.reveal(block);
  }

  /** Go to the block in the previous or next lane that is nearest in time. @param {-1 | 1} step */
  #goLane(step) {
    const { channel, start } = this.#order[this.#current];
    const lanes = [...new Set(this.#order.map((block) => block.channel))];
    const wanted = lanes[lanes.indexOf(channel) + step];
    if (wanted === undefined) return;
    /** @param {Block} block */
    const far = (block) => Math.abs(block.start - start);
    const own = this.#order.filter((block) => block.channel === wanted);
    this.#go(this.#order.indexOf(own.reduce((best, block) => (far(block) < far(best) ? block : best))));
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const done = this.#walk(event) || this.#shape(event) || this.#back(event);
    if (!done) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {KeyboardEvent} event */
  #walk({ key, ctrlKey, metaKey, altKey }) {
    if (ctrlKey || metaKey || altKey || this.#order.length === 0) return false;
    /** @type {Record<string, () => void>} */
    const steps = {
      ArrowUp: () => this.#go(this.#current - 1),
      ArrowDown: () => this.#go(this.#current + 1),
      PageUp: () => this.#goLane(-1),
      PageDown: () => this.#goLane(1),
      Home: () => this.#go(0),
      End: () => this.#go(this.#order.length - 1),
      Enter: () => this.#go(this.#current),
      Delete: () => this.#controller.remove(),
      Backspace: () => this.#controller.remove(),
      Escape: () => this.#controller.choose(null),
    };
    steps[key]?.();
    return key in steps;
  }

  /** Undo and redo, after pending keyboard edits were sent. @param {KeyboardEvent} event */
  #back({ key, ctrlKey, metaKey, shiftKey }) {
    if (!(ctrlKey || metaKey)) return false;
    const again = (key.toLowerCase() === "z" && shiftKey) || key === "y";
    if (again) this.#controller.redo();
    else if (key.toLowerCase() === "z") this.#controller.undo();
    else return false;
    return true;
  }

  /**
   * Left and right arrows move the block by a frame; with Shift its end, Alt its start, Ctrl its onset, Ctrl Shift its offset.
   * @param {KeyboardEvent} event
   */
  #shape({ key, ctrlKey, metaKey, altKey, shiftKey }) {
    if (key !== "ArrowLeft" && key !== "ArrowRight") return false;
    const frames = key === "ArrowLeft" ? -1 : 1;
    if (ctrlKey || metaKey) this.#controller.nudge(shiftKey ? 2 : 1, frames);
    else if (altKey) this.#controller.nudge(0, frames);
    else this.#controller.nudge(shiftKey ? 3 : "move", frames);
    const block = this.#order[this.#current];
    const option = this.#list.querySelector('[tabindex="0"]');
    if (option) option.textContent = described(block, this.#controller);
    if (block) this.#said.textContent = block.free ? timesTold(block, this.#controller) : "cannot be changed";
    return true;
  }
}

/** Return a block's times in a few words. @param {Block} block @param {TimelineController} controller */
function timesTold(block, controller) {
  const [start, rise, fall, end] = timesOf(controller.edits.shown(block) ?? block).map((time) => time.toFixed(2));
  return `${start} to ${end}, apex ${rise} to ${fall}`;
}

/** Describe a block in a sentence. @param {Block} block @param {TimelineController} controller */
export function described(block, controller) {
  const shown = controller.edits.shown(block) ?? block;
  const targets = Object.entries(shown.targets).slice(0, 4);
  const what = targets.map(([name, value]) => `${spoken(name)} ${Number(value.toFixed(2))}`).join(", ");
  const more = Object.keys(shown.targets).length > 4 ? " and more" : "";
  const name = block.editable ? block.label : block.label ? `phone ${block.label}` : "silence";
  return (
    `${name}, ${block.channel}, from ${shown.start.toFixed(2)} to ${shown.end.toFixed(2)} seconds, ` +
    `onset ${(shown.apex_start - shown.start).toFixed(2)}, offset ${(shown.end - shown.apex_end).toFixed(2)}` +
    `${what ? `: ${what}${more}` : ""}${block.free ? "" : "; cannot be changed"}`
  );
}
