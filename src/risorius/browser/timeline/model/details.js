import { floatsOf } from "../../player/take.js";
/** @import {Detail} from "../../types.js" */
/** @import {ChannelCurve} from "../../wire.js" */

/**
 * The value that each channel requests of a parameter and the one it gets: fetched for shown graphs, cached per take.
 */
export class Details {
  /** @type {Map<string, {take: number, detail: Detail}>} */
  #known = new Map(); // parameter -> {take, detail}; an older take's is shown until the new one arrives
  #asked = new Set();
  #take = 0;
  #actions;
  #changed;

  /** @param {import("../../studio/actions.js").Actions} actions @param {() => void} changed */
  constructor(actions, changed) {
    this.#actions = actions;
    this.#changed = changed;
  }

  /** Switch to another take. @param {number} take @param {boolean} other whether it is another performance */
  setTake(take, other) {
    this.#take = take;
    this.#asked.clear();
    if (other) this.#known.clear();
  }

  /**
   * @param {string} name
   * @returns {Detail | null} the detail of a parameter, or null if it has not arrived
   */
  of(name) {
    return this.#known.get(name)?.detail ?? null;
  }

  /** Fetch the detail of a parameter for the current take, unless it is cached. @param {string} name */
  want(name) {
    if (this.#asked.has(name) || this.#known.get(name)?.take === this.#take) return;
    this.#asked.add(name);
    this.#fetch(name, this.#take);
  }

  /** @param {string} parameter @param {number} take */
  async #fetch(parameter, take) {
    const answer = await this.#actions.ask("channel_curves", { take, parameter });
    if (answer === null || take !== this.#take) return;
    const channels = /** @type {ChannelCurve[]} */ (answer.channels).map((one) => {
      return { ...one, asked: floatsOf(one.asked), given: floatsOf(one.given) };
    });
    this.#known.set(parameter, { take, detail: { ...answer, channels } });
    this.#changed();
  }
}
