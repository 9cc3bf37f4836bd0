/**
 * The page's state: one flat object of named parts, and who wants to know when one is replaced.
 *
 * Parts are never changed in place: `store.set({take})` replaces, and calls everyone who watches `take`
 * once, after all parts of the same `set` are in place.
 *
 * Parts:
 *   catalogue   tables of the server (GET /api/catalogue); null until loaded
 *   session     {id, name}; null until open
 *   link        "up" | "down" | "lost": the socket
 *   saved       "saved" | "saving" | "failed"
 *   settings    settings of the performance, as the wire names them
 *   script      text to be said
 *   spans       emotions on stretches of the text
 *   take        the current take as the server describes it; null before the first
 *   busy        sentence of what is being waited for; "" when nothing is
 *   selection   {time, parameter, movement}: what was last pointed at in timeline or rules; each may be null
 *   other       the second take of a comparison; null without one
 *   dial        {name: value} while dials show a face of their own; null while the take is shown
 *   camera      name of the camera
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
