/** Draft pictures of the server (`GET /picture.webp`), for browsers without a graphics card. */

const DIGITS = 3; // of the values
const MM = 1000; // to a metre
const BUSY = 503;
const AGAIN = 100; // ms to wait before asking a busy server again

/**
 * @typedef {{head?: string, age?: number | null, hair?: string | null, complexion?: number | null}} Person as choices have it
 * @typedef {{eye: number[], target: number[], field: number}} PictureCamera places in metres, the vertical angle in degrees
 */

/**
 * Return the query for the server.
 * @param {Person} person @param {ArrayLike<number> | null} values of all parameters; null: the face is at rest
 * @param {{width: number, height: number}} size in pixels; the server uses their ratio @param {PictureCamera | null} camera null: the head is framed
 */
export function pictureQuery({ head, age, hair, complexion }, values, { width, height }, camera) {
  /** @param {ArrayLike<number>} numbers */
  const list = (numbers) => Array.from(numbers, (number) => String(Number(number.toFixed(DIGITS)))).join(",");
  const place = camera && { eye: list(camera.eye.map(inMm)), target: list(camera.target.map(inMm)), field: camera.field };
  const asked = { head, age, hair, complexion, width: Math.round((360 * width) / height), ...place, values: values && list(values) };
  const given = Object.entries(asked).filter(([, value]) => value !== null && value !== undefined);
  return new URLSearchParams(given.map(([name, value]) => [name, String(value)])).toString();
}

/** @param {number} metres */
function inMm(metres) {
  return MM * metres;
}

/**
 * Fetch a picture; throws the server's message if it cannot be drawn.
 * @param {string} query @param {string} [token] of the server
 */
export async function fetchPicture(query, token) {
  const headers = token ? { authorization: `Bearer ${token}` } : undefined;
  for (;;) {
    const response = await fetch(`/picture.webp?${query}`, { headers });
    if (response.ok) return createImageBitmap(await response.blob());
    if (response.status !== BUSY) throw new Error((await response.text()).trim() || response.statusText);
    await new Promise((go) => setTimeout(go, AGAIN));
  }
}

/** Runs one task at a time; of the tasks requested meanwhile, only the newest runs. @template T */
export class Newest {
  #work;
  /** @type {{wish: T} | null} */
  #waiting = null;
  #busy = false;

  /** @param {(wish: T) => Promise<void>} work which does not throw */
  constructor(work) {
    this.#work = work;
  }

  /** Whether a task is running. */
  get busy() {
    return this.#busy;
  }

  /** @param {T} wish */
  ask(wish) {
    this.#waiting = { wish };
    if (!this.#busy) this.#run();
  }

  async #run() {
    this.#busy = true;
    while (this.#waiting) {
      const { wish } = this.#waiting;
      this.#waiting = null;
      await this.#work(wish);
    }
    this.#busy = false;
  }
}
