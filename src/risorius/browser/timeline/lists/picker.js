import { h, spoken } from "../dom.js";
/** @import {Base} from "../../types.js" */

/**
 * Choose the muscles whose graphs are shown: a searchable list that marks the ones that move.
 */
export class Picker {
  #graphs;
  #controller;
  #search = h("input", { type: "search", "aria-label": "Search muscles", placeholder: "Search: name, AU, number, group" });
  #found = h("div", { class: "tl-found stack" });
  #box;

  /** @param {HTMLElement} parent @param {import("../controller.js").TimelineController} controller @param {import("../model/graphs.js").Graphs} graphs */
  constructor(parent, controller, graphs) {
    this.#controller = controller;
    this.#graphs = graphs;
    const reset = h("button", { onclick: () => this.#reset() }, "Muscles that move most");
    this.#box = h("div", { class: "tl-picker", popover: "auto", id: "tl-picker", role: "dialog", "aria-label": "Graphs" },
      this.#search, this.#found, reset); // prettier-ignore
    this.#search.addEventListener("input", () => this.#show());
    this.#box.addEventListener("toggle", ({ newState }) => newState === "open" && this.#search.focus());
    this.#box.addEventListener("keydown", (event) => event.stopPropagation());
    parent.append(this.#box);
  }

  /** The button that opens it. */
  button() {
    const button = h("button", { popovertarget: "tl-picker", "aria-haspopup": "dialog" }, "Graphs…");
    button.addEventListener("click", () => {
      const { left, top } = button.getBoundingClientRect();
      this.#box.style.left = `${Math.min(left, innerWidth - 320)}px`;
      this.#box.style.bottom = `${Math.max(8, innerHeight - top + 4)}px`;
      this.#show();
    });
    return button;
  }

  #reset() {
    this.#graphs.reset();
    this.#show();
  }

  #show() {
    const { model } = this.#controller.scene;
    if (!model) return;
    const wanted = this.#search.value.trim().toLowerCase();
    const bases = [...model.bases.values()].filter(({ base, names }) => this.#text(base, names[0]).includes(wanted));
    this.#found.replaceChildren(...bases.map((entry) => this.#line(entry)));
    if (bases.length === 0) this.#found.append(h("p", { class: "hint" }, "No muscle matches."));
  }

  /** Return the texts that a search for a muscle looks in. @param {string} base @param {string} name */
  #text(base, name) {
    const { catalogue } = this.#controller.scene.model;
    const { number, group } = this.#controller.scene.model.parameter(name);
    const units = catalogue.action_units.filter(({ targets }) => name in targets);
    const words = [base, spoken(base), group, number === null ? "" : String(number).padStart(2, "0")];
    return [...words, ...units.map((unit) => `${unit.name} ${unit.title}`)].join(" ").toLowerCase();
  }

  /** @param {Base} base */
  #line({ base, names }) {
    const { model } = this.#controller.scene;
    const { number } = model.parameter(names[0]);
    const still = names.every((name) => model.curve(name) === null);
    const box = h("input", { type: "checkbox", onchange: () => this.#graphs.toggle(base) });
    box.checked = this.#graphs.has(base);
    const name = `${number === null ? "" : `${String(number).padStart(2, "0")} `}${spoken(base)}`;
    return h("label", { class: "check" }, box, h("span", {}, name), still ? h("span", { class: "hint" }, "at rest") : null);
  }
}
