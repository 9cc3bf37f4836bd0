/**
 * The socket to the server: requests with replies, pushed events, binary messages; it reconnects by itself.
 *
 * `request("undo", {})` resolves to the reply's `ok`, rejects with `Refusal` (the server's one line) or
 * `Disconnected`. `on(name, call)` listens for the server's events and for "up" and "down", binary messages
 * (ArrayBuffer) with `on("binary", call)`.
 */

const FIRST_WAIT = 250; // ms before the first attempt to reconnect
const LONGEST_WAIT = 5000;

/** The server's answer to a request that it cannot fulfil. */
class Refusal extends Error {}

/** The socket closed before the answer came. */
class Disconnected extends Error {}

export class Connection {
  #url;
  /** @type {WebSocket | null} */
  #socket = null;
  #next = 1;
  #waiting = new Map();
  #calls = new Map();
  #wait = FIRST_WAIT;
  #timer = 0;
  #ended = false;

  /** @param {string} url ws://… */
  constructor(url) {
    this.#url = url;
    this.#connect();
  }

  /** Whether requests can be sent now. */
  get up() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /**
   * Hear events: "up", "down", "binary", or an event's name in the server's table.
   * @param {string} name @param {(message: any) => void} call @returns {() => void} ends it
   */
  on(name, call) {
    if (!this.#calls.has(name)) this.#calls.set(name, new Set());
    this.#calls.get(name).add(call);
    return () => this.#calls.get(name).delete(call);
  }

  /**
   * Ask the server to do something.
   * @param {string} verb @param {Record<string, any>} [fields]
   * @param {(id: number) => void} [begun] receives the request's number, which stops it
   * @returns {Promise<any>} the reply's `ok`
   */
  request(verb, fields = {}, begun = () => {}) {
    if (!this.up) return Promise.reject(new Disconnected("the studio's server cannot be reached"));
    const id = this.#next++;
    begun(id);
    this.#socket?.send(JSON.stringify({ id, do: verb, ...fields }, withoutNulls));
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  /** Let all listeners reload the session, as after a lost connection. */
  reopen() {
    if (this.up) this.#tell("up", null);
  }

  /** Drop the connection, as a network failure would; it reconnects. */
  drop() {
    this.#socket?.close();
  }

  /** Close for good. */
  end() {
    this.#ended = true;
    clearTimeout(this.#timer);
    this.#socket?.close();
  }

  #connect() {
    const socket = new WebSocket(this.#url);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.#wait = FIRST_WAIT;
      this.#tell("up", null);
    };
    socket.onmessage = ({ data }) => this.#receive(data);
    socket.onclose = (event) => this.#closed(socket, event);
    this.#socket = socket;
  }

  /** @param {string | ArrayBuffer} data */
  #receive(data) {
    if (data instanceof ArrayBuffer) {
      this.#tell("binary", data);
      return;
    }
    const message = JSON.parse(data);
    if (message.event !== undefined) {
      this.#tell(message.event, message);
      return;
    }
    const waiting = this.#waiting.get(message.re);
    this.#waiting.delete(message.re);
    if (message.error === undefined) waiting?.resolve(message.ok);
    else waiting?.reject(new Refusal(message.error));
  }

  /** @param {WebSocket} socket @param {CloseEvent} event */
  #closed(socket, event) {
    if (socket !== this.#socket) return;
    for (const { reject } of this.#waiting.values()) reject(new Disconnected("the connection was lost"));
    this.#waiting.clear();
    this.#tell("down", event);
    if (this.#ended) return;
    this.#timer = setTimeout(() => this.#connect(), this.#wait);
    this.#wait = Math.min(2 * this.#wait, LONGEST_WAIT);
  }

  /** @param {string} name @param {unknown} message */
  #tell(name, message) {
    for (const call of [...(this.#calls.get(name) ?? [])]) call(message);
  }
}

/**
 * Null fields are left out: null is the default of the wire's fields.
 * @param {string} key @param {unknown} value
 */
function withoutNulls(key, value) {
  if (value === null || typeof value !== "object" || Array.isArray(value)) return value;
  return Object.fromEntries(Object.entries(value).filter(([, inner]) => inner !== null));
}
