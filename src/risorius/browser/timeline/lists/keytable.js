import { h, spoken } from "../dom.js";
import { SHAPES, shapeOf, shaped } from "../model/key_shapes.js";
import { withKey, withMoved } from "../model/keys.js";
/** @import {Key} from "../../types.js" */

/**
 * The keys drawn by hand on a parameter, as a table of numbers: an alternative to the mouse.
 */

const MOST = 60; // rows; more are edited on the graph

export class KeyTable {
  #controller;

  /** @param {import("../controller.js").TimelineController} controller */
  constructor(controller) {
    this.#controller = controller;
  }

  /** @param {string} name with or without its side @param {number} time where a key is added */
  element(name, time) {
    const [parameter] = this.#controller.scene.model.named(name);
    const keys = this.#controller.edits.keys(parameter);
    const { unit, low, high } = this.#controller.scene.model.parameter(parameter);
    const add = h("button", { id: "tl-key-add", onclick: () => this.#add(parameter, time) }, "Set a key here");
    const clear = h("button", { id: "tl-key-clear", onclick: () => this.#send(parameter, []) }, "Delete all keys");
    const head = h("tr", {}, ...["Time, s", `Value${unit ? `, ${unit}` : ""}`, "Shape", ""].map((text) => h("th", { scope: "col" }, text)));
    const rows = keys.slice(0, MOST).map((key, index) => this.#row(parameter, key, index, { low, high }));
    return h("section", { class: "stack" },
      h("h3", {}, "Drawn by hand"),
      keys.length ? h("table", { class: "tl-keys" }, h("thead", {}, head), h("tbody", {}, ...rows)) : null,
      keys.length > MOST ? h("p", { class: "hint" }, `and ${keys.length - MOST} more`) : null,
      h("div", { class: "row" }, add, keys.length ? clear : null)); // prettier-ignore
  }

  /** @param {string} parameter @param {Key} key @param {number} index @param {{low: number, high: number}} bounds */
  #row(parameter, key, index, { low, high }) {
    const [time, value] = key;
    const what = `key ${index + 1} of ${spoken(parameter)}`;
    const [at, amount] = [time, value].map((number, k) => {
      const bounds = k ? { min: low, max: high } : { min: 0 };
      const label = `${k ? "Value" : "Time"} of ${what}`;
      const input = h("input", { id: `tl-key-${index}-${k}`, type: "number", step: "0.01", "aria-label": label, ...bounds });
      input.value = String(Number(number.toFixed(3)));
      return input;
    });
    const change = () => this.#move(parameter, index, Number(at.value), Number(amount.value));
    for (const input of [at, amount]) input.addEventListener("change", change);
    const shape = this.#shape(parameter, key, index, what);
    const remove = () => this.#controller.removeKey({ parameter, index });
    const away = h("button", { "aria-label": `Delete ${what}`, title: "Delete", onclick: remove }, "×");
    return h("tr", {}, ...[at, amount, shape, away].map((part) => h("td", {}, part)));
  }

  /** Return the list of shapes of a key. @param {string} parameter @param {Key} key @param {number} index @param {string} what */
  #shape(parameter, key, index, what) {
    const options = Object.entries(SHAPES).map(([name, title]) => h("option", { value: name }, title));
    const list = h("select", { id: `tl-key-${index}-shape`, "aria-label": `Shape of ${what}` }, ...options);
    list.value = shapeOf(key);
    list.addEventListener("change", () => {
      const kind = /** @type {keyof SHAPES} */ (list.value);
      this.#send(parameter, shaped(this.#controller.edits.keys(parameter), index, kind));
    });
    return list;
  }

  /** @param {string} parameter @param {number} time */
  #add(parameter, time) {
    const { model } = this.#controller.scene;
    const keys = this.#controller.edits.keys(parameter);
    this.#send(parameter, withKey(keys, time, model.valueAt(parameter, time), model.around(parameter)));
  }

  /** @param {string} parameter @param {number} index @param {number} time @param {number} value */
  #move(parameter, index, time, value) {
    const { duration } = this.#controller.scene.model;
    this.#send(parameter, withMoved(this.#controller.edits.keys(parameter), index, time, value, duration));
  }

  /** @param {string} parameter @param {Key[]} keys */
  #send(parameter, keys) {
    return this.#controller.edits.sendKeys(this.#controller.partners(parameter), keys);
  }
}
