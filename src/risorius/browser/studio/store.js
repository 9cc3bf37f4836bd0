/**
 * The page's state: one flat object of named parts, and who wants to know when one is replaced.
 *
 * Parts are never changed in place: `store.set({take})` replaces, and calls everyone who watches `take`
 * once, after all parts of the same `set` are in place.
 *
 * @typedef {ReturnType<typeof import("../player/take.js").takeOf>} Take
 * @typedef {Object} Parts
 * @property {import("../wire.js").Catalogue} catalogue tables of the server (GET /api/catalogue); null until loaded
 * @property {string} session the session's id; "" until open
 * @property {"up" | "down"} link
 * @property {string} saved "saved", "saving", or a line that says why it failed
 * @property {Required<import("../wire.js").Source>} source what is to be performed
 * @property {import("../wire.js").Choices} choices the settings of the next performance
 * @property {Required<import("../wire.js").EmotionSpan>[]} emotions
 * @property {"saved" | "saving"} draft whether the server has what is written but not performed
 * @property {import("../types.js").Written | null} aside what was written and put aside for what is performed
 * @property {Take | null} take the current take; null before the first
 * @property {{take: number, first: number, last: number} | null} faces frames whose faces are other than before
 * @property {string} busy a sentence on what is being waited for; "" when nothing is
 * @property {boolean} stoppable whether what is being waited for can be stopped
 * @property {import("../types.js").Selection} selection what was last pointed at
 * @property {(Take & {label: string}) | null} other the second take of a comparison
 * @property {boolean} preview whether the timeline shows a change that is not made yet
 * @property {import("../types.js").DialledFace | null} dial what dials hold, as `Dial` of the wire; null while the take is shown
 * @property {Record<string, number> | null} dialled the values of all parameters of that face; null until the server tells
 * @property {Map<string, Float32Array | null> | null} tried the curves that such a change makes other; null where one comes to rest
 * @property {string[]} recordings names of the recordings that the session has
 * @property {string[]} ownEmotions names of emotions saved in the session
 * @property {Record<string, Record<string, number>>} poses poses saved in the session
 * @property {import("../wire.js").GraphsView | null} graphs which muscles' graphs the timeline shows, and which lanes are folded; null until chosen
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
