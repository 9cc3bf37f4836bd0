/**
 * Long work: its name and progress are shown, and it can be stopped.
 *
 * Several tasks may run; the last to start is shown (`busy` in the store), and is stopped first.
 */

export class Work {
  #store;
  #connection;
  #doing = new Map(); // by the request's number or a symbol: the text shown, and the function that stops it

  /** @param {import("./store.js").Store} store @param {import("./connection.js").Connection} connection */
  constructor(store, connection) {
    this.#store = store;
    this.#connection = connection;
    connection.on("progress", ({ re, stage, done, total }) => {
      const doing = this.#doing.get(re);
      if (!doing) return;
      doing.said = total ? `${stage} ${Math.round((100 * done) / total)} %` : stage;
      this.#show();
    });
  }

  /**
   * @param {string} verb @param {Record<string, any>} fields @param {string} said until its progress is reported
   * @returns {Promise<any>} the server's answer
   */
  async request(verb, fields, said) {
    let number = 0;
    const stop = () => this.#connection.request("stop", { request: number }).catch(() => {});
    /** @param {number} id */
    const begun = (id) => {
      number = id;
      this.#begin(id, said, stop);
    };
    try {
      return await this.#connection.request(verb, fields, begun);
    } finally {
      this.#end(number);
    }
  }

  /**
   * Run work whose progress the server does not report. @template T
   * @param {string} said @param {(signal: AbortSignal) => Promise<T>} work ends when the signal says so
   * @returns {Promise<T>}
   */
  async during(said, work) {
    const [key, control] = [Symbol(said), new AbortController()];
    this.#begin(key, said, () => control.abort());
    try {
      return await work(control.signal);
    } finally {
      this.#end(key);
    }
  }

  /** Stop the work that began last. */
  stop() {
    [...this.#doing.values()].at(-1)?.stop();
  }

  /** @param {number | symbol} key @param {string} said @param {() => void} stop */
  #begin(key, said, stop) {
    this.#doing.set(key, { said, stop });
    this.#show();
  }

  /** @param {number | symbol} key */
  #end(key) {
    this.#doing.delete(key);
    this.#show();
  }

  #show() {
    const last = [...this.#doing.values()].at(-1);
    this.#store.set({ busy: last?.said ?? "", stoppable: last !== undefined });
  }
}
