/**
 * The page's state: one flat object of named parts, and who wants to know when one is replaced.
 *
 * Parts are never changed in place: `store.set({take})` replaces, and calls everyone who watches `take`
 * once, after all parts of the same `set` are in place.
 *
 * Parts:
 *   catalogue   tables of the server (GET /api/catalogue); null until loaded
 *   session     the session's id; "" until open
 *   link        "up" | "down"
 *   saved       "saved" | "saving" | a line that says why it failed
 *   source      {script, format, recording}: what is to be performed (`Source` of the wire)
 *   choices     `Choices` of the wire: the settings of the next performance
 *   emotions    `EmotionSpan`s of the wire
 *   draft       "saved" | "saving": whether the server has what is written but not performed
 *   aside       what was written and was put aside for what is performed; null if nothing
 *   take        the current take (`take.js`); null before the first
 *   faces       {take, first, last}: frames whose faces are other than before, set with each new take
 *   busy        a sentence on what is being waited for; "" when nothing is
 *   stoppable   whether what is being waited for can be stopped
 *   selection   {time, parameter, movement}: what was last pointed at in timeline or rules; each may be null
 *   other       the second take of a comparison; null without one
 *   preview     whether the timeline shows a change that is not made yet
 *   dial        what dials hold, as `Dial` of the wire; null while the take is shown
 *   recordings  names of the recordings that the session has
 *   ownEmotions names of emotions saved in the session
 *   poses       {name: {parameter: value}}: poses saved in the session
 *   graphs      which muscles' graphs the timeline shows, and which lanes are folded; null until chosen
 *   tab         name of the panel that is open
 */
export class Store {
  #parts;
  #watchers = new Set();

  /** @param {Record<string, any>} parts the state to begin with */
  constructor(parts) {
    this.#parts = { ...parts };
  }

  /** @param {string} name @returns {any} the part's value now */
  get(name) {
    return this.#parts[name];
  }

  /** Replace parts; those that are the same as before are not announced. @param {Record<string, any>} parts */
  set(parts) {
    const changed = Object.keys(parts).filter((name) => this.#parts[name] !== parts[name]);
    Object.assign(this.#parts, parts);
    for (const { names, call } of [...this.#watchers]) {
      if (names.some((name) => changed.includes(name))) call(this);
    }
  }

  /**
   * Call `call(store)` now and after each change of one of the parts.
   * @param {string[]} names @param {(store: Store) => void} call
   * @returns {() => void} ends it
   */
  watch(names, call) {
    const watcher = { names, call };
    this.#watchers.add(watcher);
    call(this);
    return () => this.#watchers.delete(watcher);
  }
}
