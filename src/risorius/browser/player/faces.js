/** The faces of the performance: chunks near the playhead are inflated, the others stay packed. */

import { inflated } from "./data.js";
/** @import {PlayedFacts} from "../types.js" */
/** @import {Face} from "../stage/faces.js" */

const KEPT = 4; // chunks, of a second or so each

export class PlayedFaces {
  #facts;
  #poses;
  /** @type {Promise<Int16Array> | null} the points of the first face */
  #base = null;
  /** @type {Map<number, Face[] | null>} */
  #chunks = new Map(); // number -> faces, or null while they are inflated
  #arrived;

  /** @param {PlayedFacts} facts of the page @param {Float32Array} poses @param {() => void} arrived */
  constructor(facts, poses, arrived) {
    this.#facts = facts;
    this.#poses = poses;
    this.#arrived = arrived;
  }

  /** @param {number} frame @returns {import("../stage/faces.js").Face | null} null while it is not ready */
  at(frame) {
    const { chunk, frames } = this.#facts;
    const number = Math.floor(frame / chunk);
    this.#want(number);
    if ((number + 1) * chunk < frames) this.#want(number + 1);
    return this.#chunks.get(number)?.[frame - number * chunk] ?? null;
  }

  /** @param {number} number */
  #want(number) {
    if (this.#chunks.has(number)) return;
    for (const old of this.#chunks.keys()) if (this.#chunks.size >= KEPT) this.#chunks.delete(old);
    this.#chunks.set(number, null);
    this.#unpack(number);
  }

  /** @param {number} number */
  async #unpack(number) {
    const first = (this.#base ??= this.#points(0, null).then(([face]) => face));
    const points = await (number === 0 ? this.#points(0, null) : first.then((base) => this.#points(number, base)));
    if (!this.#chunks.has(number)) return;
    this.#chunks.set(number, points.map((own, k) => this.#face(own, number * this.#facts.chunk + k)));
    this.#arrived();
  }

  /**
   * Decode the points of a chunk's faces, then the heights of their wrinkles; each is stored as the difference to the previous one.
   * @param {number} number @param {Int16Array | null} base
   */
  async #points(number, base) {
    const bytes = new Uint8Array(await inflated(`faces-${number}`));
    const { vertices, folds } = this.#facts.stage;
    const [half, count] = [bytes.length / 2, 3 * vertices + folds.count];
    let before = base ?? new Int16Array(count);
    return Array.from({ length: half / count }, (_, face) => {
      const points = new Int16Array(count);
      let k = face * count;
      /** @param {number} to */
      const unfold = (to) => {
        const folded = bytes[k] | (bytes[half + k++] << 8);
        points[to] = before[to] + ((folded >> 1) ^ -(folded & 1));
      };
      for (let axis = 0; axis < 3; axis++) for (let to = axis; to < 3 * vertices; to += 3) unfold(to);
      for (let to = 3 * vertices; to < count; to++) unfold(to);
      before = points;
      return points;
    });
  }

  /** @param {Int16Array} numbers @param {number} frame @returns {Face} */
  #face(numbers, frame) {
    const { pose, vertices } = this.#facts.stage;
    const [points, folds] = [numbers.subarray(0, 3 * vertices), numbers.subarray(3 * vertices)];
    const turns = this.#poses.subarray(frame * pose, (frame + 1) * pose);
    const eyes = [turns.subarray(4, 8), turns.subarray(8, 12)];
    return { points, folds, head: turns.subarray(0, 4), eyes, jaw: turns[12], lips: turns[13] };
  }
}
