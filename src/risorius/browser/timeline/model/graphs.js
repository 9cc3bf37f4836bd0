/**
 * The muscles (and sides) whose graphs are shown: those that move most, until the user chooses.
 */

/** @import {Sides} from "../../types.js" */

const SHOWN = 5;

export class Graphs {
  /** @type {string[] | null} bases, once the user has chosen */
  #chosen = null;
  /** @type {string[]} */
  #lively = [];
  /** @type {Map<string, Sides>} */
  #sides = new Map();
  #changed;
  /** @type {import("./model.js").Model | null} */
  #model = null;

  /** @param {() => void} changed */
  constructor(changed) {
    this.#changed = changed;
  }

  /** @param {import("./model.js").Model} model @param {boolean} fresh another performance, not an edit of one */
  setModel(model, fresh) {
    this.#model = model;
    if (fresh || this.#lively.length === 0) this.#lively = model.liveliest.slice(0, SHOWN);
  }

  /** Names without sides, in the order in which they are shown. */
  get bases() {
    if (this.#model === null) return [];
    return this.#chosen ?? this.#lively;
  }

  /** The rows: the names of the chosen sides, the left first. */
  get rows() {
    const model = this.#model;
    if (model === null) return [];
    return this.bases.map((base) => {
      const { names } = model.base(base);
      const side = this.side(base);
      return { base, names: side === "both" ? names : names.filter((name) => name.endsWith(`.${side}`)) };
    });
  }

  /** @param {string} base */
  side(base) {
    return this.#sides.get(base) ?? "both";
  }

  /** @param {string} base @param {Sides} side */
  setSide(base, side) {
    this.#sides.set(base, side);
    this.#changed();
  }

  /** @param {string} base */
  has(base) {
    return this.bases.includes(base);
  }

  /** @param {string} base */
  toggle(base) {
    const { bases } = this;
    this.#chosen = bases.includes(base) ? bases.filter((other) => other !== base) : [...bases, base];
    this.#changed();
  }

  /** Show those that move most again. */
  reset() {
    this.#chosen = null;
    this.#changed();
  }

  /** The state to save with the project. */
  get kept() {
    return { chosen: this.#chosen, sides: Object.fromEntries(this.#sides) };
  }

  /** Restore a saved state. @param {import("../../wire.js").GraphsView} kept @param {import("./model.js").Model} model */
  restore({ chosen = null, sides = {} }, model) {
    /** @param {string} base */
    const known = (base) => model.bases.has(base);
    this.#chosen = Array.isArray(chosen) ? chosen.filter(known) : null;
    this.#sides = new Map(Object.entries(sides).filter(([base]) => known(base)));
  }
}
