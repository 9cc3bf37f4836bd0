/** Figures of heads, fetched on demand and cached. */

import { buildFigure } from "../stage/figure.js";
/** @import {Choices} from "../wire.js" */

const MOST = 3;

export class Heads {
  #coarse;
  /** @type {Map<string, Promise<import("../stage/figure.js").Figure>>} */
  #kept = new Map();

  /** @param {{coarse?: boolean}} [how] `coarse`: whether the heads have few triangles */
  constructor({ coarse = false } = {}) {
    this.#coarse = coarse;
  }

  /**
   * Return the figure of the head in the choices. Each `place` has a figure of its own.
   * @param {Choices} choices of the wire @param {number} place
   * @returns {Promise<import("../stage/figure.js").Figure>}
   */
  get(choices, place = 0) {
    const asked = query(choices);
    const key = `${place}?${asked}`;
    const found = this.#kept.get(key) ?? this.#fetch(asked);
    this.#kept.delete(key);
    this.#kept.set(key, found);
    found.catch(() => this.#kept.delete(key));
    this.#dropOldest();
    return found;
  }

  #dropOldest() {
    for (const [key, figure] of [...this.#kept].slice(0, Math.max(0, this.#kept.size - MOST))) {
      this.#kept.delete(key);
      figure.then((it) => it.dispose());
    }
  }

  /**
   * A head is shown together with its shade data (without it the neckline is ragged), which the server may have to compute first.
   * @param {string} asked
   */
  async #fetch(asked) {
    const [packing, head, shade, folds, skin] = await Promise.all([
      answered(`/api/stage?${asked}`).then((response) => response.json()),
      ...[`head?${asked}`, `shade?${asked}`, `folds?${asked}`, "skin"].map(bytesOf),
    ]);
    return buildFigure({ head, shade, folds, skin }, packing, this.#coarse);
  }
}

/** @param {Pick<Choices, "head" | "age" | "hair" | "complexion">} choices */
function query({ head, age, hair, complexion }) {
  const given = Object.entries({ head, age, hair, complexion }).filter(
    ([, value]) => value !== null && value !== undefined,
  );
  return new URLSearchParams(given.map(([name, value]) => [name, String(value)])).toString();
}

/** @param {string} name of what is asked */
async function bytesOf(name) {
  return (await answered(`/api/${name}`)).arrayBuffer();
}

/** @param {string} address */
async function answered(address) {
  const response = await fetch(address);
  if (!response.ok) throw new Error((await response.text()).trim() || response.statusText);
  return response;
}
