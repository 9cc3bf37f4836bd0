import { told } from "../parts/dom.js";
/** @import {DialledFace} from "../types.js" */

/**
 * Sends the dialled face to the server: one request at a time, then the newest face,
 * so that a slow machine is never more than one face behind.
 */
export class Dialler {
  #studio;
  #said;
  #busy = false;
  /** @type {Record<string, any> | null} a request of the wire */
  #waiting = null;

  /** @param {import("../studio/studio.js").Studio} studio @param {(line: string) => void} said receives the reason if a face cannot be shown */
  constructor(studio, said) {
    this.#studio = studio;
    this.#said = said;
  }

  /** Show a face in place of the take. @param {DialledFace} face `values` and `emotions` @param {boolean} live */
  show(face, live) {
    const { store, clock } = this.#studio;
    clock.pause();
    store.set(store.get("dial") ? { dial: face } : { dial: face, dialled: null });
    const { head, age } = store.get("choices");
    this.#waiting = { ...face, live, head, age };
    if (!this.#busy) this.#send();
  }

  async #send() {
    this.#busy = true;
    while (this.#waiting) {
      const asked = this.#waiting;
      this.#waiting = null;
      try {
        const { notes, values } = await this.#studio.connection.request("dial", asked);
        this.#studio.store.set({ dialled: values });
        this.#said(notes.join(" · "));
      } catch (error) {
        this.#said(told(error));
      }
    }
    this.#busy = false;
  }
}
