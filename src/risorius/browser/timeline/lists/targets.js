import { h, spoken } from "../dom.js";
/** @import {Block} from "../../types.js" */

/** @typedef {{title: string, names: string[], value: number}} Target of one side, or of both */

/**
 * The targets of a movement as editable numbers; two equal sides share one number.
 */
export class Targets {
  #controller;

  /** @param {import("../controller.js").TimelineController} controller */
  constructor(controller) {
    this.#controller = controller;
  }

  /** @param {Block} block */
  element(block) {
    const rows = this.#groups(block).map((group, k) => this.#row(block, group, k));
    return h("details", { open: rows.length <= 4 }, h("summary", {}, "Targets"),
      h("div", { class: "stack" }, ...rows)); // prettier-ignore
  }

  /** Return the targets by parameter; both sides are merged if they are the same. @param {Block} block */
  #groups({ targets }) {
    const { model } = this.#controller.scene;
    /** @type {Map<string, Target>} */
    const groups = new Map();
    for (const [name, value] of Object.entries(targets)) {
      const { base } = model.parameter(name);
      const { names } = model.base(base);
      const both = names.every((side) => targets[side] === value);
      groups.set(both ? base : name, { title: both ? base : name, names: both ? names : [name], value });
    }
    return [...groups.values()];
  }

  /** @param {Block} block @param {Target} group @param {number} k */
  #row(block, { title, names, value }, k) {
    const { low, high, unit } = this.#controller.scene.model.parameter(names[0]);
    const input = h("input", { id: `tl-target-${k}`, type: "number", min: low, max: high, step: "0.01" });
    input.value = String(Number(value.toFixed(3)));
    input.addEventListener("change", () => this.#change(block, names, input));
    return h("label", { class: "tl-target", for: input.id }, h("span", {}, `${spoken(title)}${unit ? `, ${unit}` : ""}`), input);
  }

  /** @param {Block} block @param {string[]} names @param {HTMLInputElement} input */
  #change(block, names, input) {
    const { rangeUnderflow, rangeOverflow } = input.validity;
    if (input.value === "" || rangeUnderflow || rangeOverflow) {
      input.reportValidity();
      return;
    }
    const changed = Object.fromEntries(names.map((name) => [name, Number(input.value)]));
    const targets = { ...block.targets, ...changed };
    this.#controller.actions.edit("retarget", { movement: block.id, targets });
  }
}
