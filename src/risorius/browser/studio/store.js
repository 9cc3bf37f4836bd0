/**
 * The page's state: one flat object of named parts, and the listeners to call when a part is replaced.
 *
 * Parts are never changed in place: `store.set({take})` replaces one, and calls each listener of `take`
 * once, after all parts of the same `set` are in place.
 *
 * @typedef {ReturnType<typeof import("../player/take.js").takeOf>} Take
 * @typedef {Object} Parts
 * @property {import("../wire.js").Catalogue} catalogue tables of the server (GET /api/catalogue); null until loaded
 * @property {string} session the session's id; "" until open
 * @property {"up" | "down"} link
 * @property {string} saved "saved", "saving", or a line that says why it failed
 * @property {Required<import("../wire.js").Source>} source text or recording to perform
 * @property {import("../wire.js").Choices} choices the settings of the next performance
 * @property {Required<import("../wire.js").EmotionSpan>[]} emotions
 * @property {"saved" | "saving"} draft whether the server has saved the draft
 * @property {import("../types.js").Written | null} aside the draft that was put aside while the performed text is shown
 * @property {Take | null} take the current take; null before the first
 * @property {{take: number, first: number, last: number} | null} faces frames whose faces changed
 * @property {string} busy a sentence that names the work in progress; "" if there is none
 * @property {boolean} stoppable whether the work in progress can be stopped
 * @property {import("../types.js").Selection} selection the selected part of the timeline
 * @property {(Take & {label: string}) | null} other the second take of a comparison
 * @property {boolean} preview whether the timeline previews an edit
 * @property {import("../types.js").DialledFace | null} dial the dialled face, as the wire's `Dial`; null while the take is shown
 * @property {Record<string, number> | null} dialled the values of all its parameters; null until the server has sent them
 * @property {Map<string, Float32Array | null> | null} tried the curves that the previewed edit changes; null for a parameter that is then at rest
 * @property {string[]} recordings names of the session's recordings
 * @property {string[]} ownEmotions names of emotions saved in the session
 * @property {Record<string, Record<string, number>>} poses poses saved in the session
 * @property {import("../wire.js").GraphsView | null} graphs muscles whose graphs the timeline shows, and folded lanes; null until chosen
 * @property {string} tab name of the panel that is open
 */
export class Store {
  #parts;
  /** @type {Set<{names: (keyof Parts)[], call: (store: Store) => void}>} */
  #watchers = new Set();

  /** @param {Parts} parts the state to begin with */
  constructor(parts) {
    this.#parts = { ...parts };
  }

  /** @template {keyof Parts} N @param {N} name @returns {Parts[N]} the part's value now */
  get(name) {
    return this.#parts[name];
  }

  /** Replace parts; those that are the same as before are not announced. @param {Partial<Parts>} parts */
  set(parts) {
    const given = /** @type {(keyof Parts)[]} */ (Object.keys(parts));
    const changed = given.filter((name) => this.#parts[name] !== parts[name]);
    Object.assign(this.#parts, parts);
    for (const { names, call } of [...this.#watchers]) {
      if (names.some((name) => changed.includes(name))) call(this);
    }
  }

  /**
   * Call `call(store)` now and after each change of one of the parts.
   * @param {(keyof Parts)[]} names @param {(store: Store) => void} call
   * @returns {() => void} ends it
   */
  watch(names, call) {
    const watcher = { names, call };
    this.#watchers.add(watcher);
    call(this);
    return () => this.#watchers.delete(watcher);
  }
}
