/**
 * What the user can have done, by name: each asks the server, and puts its answer into the store.
 *
 * Whatever changes the take goes through here, so that all parts of the page see one take.
 * An action that is refused says so in the page's notice, and resolves to null.
 */
export class Actions {
  #store;
  #connection;
  #clock;
  #notify;

  /**
   * @param {import("./store.js").Store} store
   * @param {import("./connection.js").Connection} connection
   * @param {import("./clock.js").Clock} clock
   * @param {(text: string) => void} notify says a line to the user
   */
  constructor(store, connection, clock, notify) {
    this.#store = store;
    this.#connection = connection;
    this.#clock = clock;
    this.#notify = notify;
  }

  /** Perform the script of the store with its spans and settings anew. */
  perform() {
    const { script, spans, settings } = this.#store;
    return this.#changing("perform", { script, spans, settings }, "Performing …");
  }

  /**
   * Change the score: "move", "stretch", "add", "delete", "keys", "clear_keys", …
   * @param {string} kind @param {Record<string, any>} fields as the wire names them
   */
  edit(kind, fields) {
    return this.#changing("edit", { kind, ...fields }, "");
  }

  /** Take back the last change of the score. */
  undo() {
    return this.#changing("undo", {}, "");
  }

  /** Do again what was taken back. */
  redo() {
    return this.#changing("redo", {}, "");
  }

  /**
   * Point at something: everything that shows details follows.
   * @param {{time?: number | null, parameter?: string | null, movement?: string | null}} selection
   */
  select({ time = null, parameter = null, movement = null }) {
    this.#store.set({ selection: { time, parameter, movement } });
  }

  /**
   * Ask the server for anything else; null if it refuses, with its line shown.
   * @param {string} verb @param {Record<string, any>} [fields]
   */
  async ask(verb, fields = {}) {
    try {
      return await this.#connection.request(verb, fields);
    } catch (error) {
      this.#notify(error.message);
      return null;
    }
  }

  async #changing(verb, fields, busy) {
    this.#store.set({ busy });
    const answer = await this.ask(verb, fields);
    this.#store.set({ busy: "" });
    if (answer?.take) this.#store.set({ take: answer.take });
    return answer;
  }
}
