import { h, spoken } from "./dom.js";

/**
 * How far a movement goes in each parameter, as numbers to change; two sides that agree are one number.
 */
export class Targets {
  #controller;

  /** @param {import("./controller.js").TimelineController} controller */
  constructor(controller) {
    this.#controller = controller;
  }

  /** @param {import("../wire.js").Block} block */
  element(block) {
    const rows = this.#groups(block).map((group, k) => this.#row(block, group, k));
    return h("details", { open: rows.length <= 4 }, h("summary", {}, "Targets"),
      h("div", { class: "stack" }, ...rows)); // prettier-ignore
  }

  /** Targets by parameter, those of both sides together where they are the same. */
  #groups({ targets }) {
    const { parameters, bases } = this.#controller.scene.model;
    const groups = new Map();
    for (const [name, value] of Object.entries(targets)) {
      const { base } = parameters.get(name);
      const { names } = bases.get(base);
      const both = names.every((side) => targets[side] === value);
      groups.set(both ? base : name, { title: both ? base : name, names: both ? names : [name], value });
    }
    return [...groups.values()];
  }

  #row(block, { title, names, value }, k) {
    const { low, high, unit } = this.#controller.scene.model.parameters.get(names[0]);
    const input = h("input", { id: `tl-target-${k}`, type: "number", min: low, max: high, step: "0.01" });
    input.value = Number(value.toFixed(3));
    input.addEventListener("change", () => this.#change(block, names, input));
    return h("label", { class: "tl-target", for: input.id }, h("span", {}, `${spoken(title)}${unit ? `, ${unit}` : ""}`), input);
  }

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
