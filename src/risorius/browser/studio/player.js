/**
 * Shows the face at the clock's time on a figure: keeps a window of faces around the playhead, asks the server
 * for missing ones, and drops distant ones, so that memory does not grow with the length.
 */

import { KINDS } from "../stage/faces.js";
/** @import {Face} from "../stage/faces.js" */

const BEHIND = 2; // s of faces kept before the playhead
const AHEAD = 8; // s of faces asked for beyond it
const REFILL = 4; // s left ahead at which more is asked for
const PACE = 3; // ratio of faces sent to faces shown per second: the machine has to draw, too
const SETTLED = 300; // ms without scrubbing before faces are requested: each request is expensive for the server
const SOON = 0.5; // s beyond the last arrived frame within which a frame is waited for
const AGAIN = 400; // ms before a failed request is repeated

export class Player {
  #connection;
  #clock;
  #show;
  /** @type {{take: number, frames: number, rate: number} | null} */
  #take = null;
  /** @type {Map<number, Face>} by frame */
  #faces = new Map();
  /** @type {{first: number, last: number, arrived: number} | null} */
  #asking = null;
  #retry = 0;
  #scrubbed = -Infinity; // when the time was last set by hand
  #glancing = false;
  #previewing = false;

  /**
   * @param {import("./connection.js").Connection} connection
   * @param {import("../player/clock.js").Clock} clock
   * @param {(a: Face, b: Face, share: number) => void} show shows a blend of two faces
   */
  constructor(connection, clock, show) {
    this.#connection = connection;
    this.#clock = clock;
    this.#show = show;
    clock.on("tick", () => this.update());
    connection.on("up", () => this.#ask());
  }

  /** The number of cached faces. */
  get held() {
    return this.#faces.size;
  }

  /** The take that is shown, or null. */
  get take() {
    return this.#take;
  }

  /** The take, which must exist. */
  get #held() {
    return /** @type {{take: number, frames: number, rate: number}} */ (this.#take);
  }

  /** Whether the face of the clock's time has not arrived yet. */
  get behind() {
    return this.#take !== null && !this.#faces.has(this.#now());
  }

  /**
   * Whether an edit is previewed: then its face is shown instead of the take's, except during playback.
   * @param {boolean} previewing
   */
  set previewing(previewing) {
    this.#previewing = previewing;
    if (!previewing) this.#showNow();
  }

  /**
   * Show another take; frames outside [first, last) keep their faces.
   * @param {{take: number, frames: number, rate: number} | null} take
   * @param {number} first @param {number} last
   */
  load(take, first = 0, last = Infinity) {
    this.#take = take;
    for (const frame of [...this.#faces.keys()]) {
      if (!take || (frame >= first && frame < last) || frame >= take.frames) this.#faces.delete(frame);
    }
    this.#asking = null;
    if (!take) return;
    this.#showNow();
    this.#ask();
  }

  /** Store faces from the server. @param {ReturnType<typeof import("../stage/faces.js").unpackFaces>} sent */
  receive({ kind, take, first, faces }) {
    if (take !== this.#take?.take) return;
    if (kind === KINDS.moment) {
      if (!this.#clock.playing && (this.#previewing || this.behind)) this.#show(faces[0], faces[0], 0);
      return;
    }
    if (kind !== KINDS.take) return;
    faces.forEach((face, k) => this.#faces.set(first + k, face));
    if (this.#asking) this.#asking.arrived = first + faces.length;
    this.#showNow();
    this.#ask();
  }

  /** Follow the clock: show the face of its time if it has arrived, and request missing ones. */
  update() {
    if (!this.#take) return;
    this.#showNow();
    if (this.#clock.playing) {
      this.#ask();
      return;
    }
    this.#scrubbed = performance.now();
    this.#later(SETTLED);
    if (!this.behind || this.#begins) return;
    this.#giveUp();
    this.#glance();
  }

  /** Whether the take's first face is requested: it comes at once, since no face precedes it. */
  get #begins() {
    return this.#asking?.first === 0 && this.#now() === 0;
  }

  /** Cancel requests for another place: the server has more urgent work. */
  #giveUp() {
    const [asking, now] = [this.#asking, this.#now()];
    if (!asking || (now >= asking.first && now < asking.last) || !this.#connection.up) return;
    this.#asking = null;
    this.#connection.request("cancel", { take: this.#held.take }).catch(() => {});
  }

  #showNow() {
    if (!this.#take || (this.#previewing && !this.#clock.playing)) return;
    const at = Math.min(this.#clock.time * this.#take.rate, this.#take.frames - 1);
    const before = Math.floor(at);
    const a = this.#faces.get(before);
    if (a) this.#show(a, this.#faces.get(Math.min(before + 1, this.#take.frames - 1)) ?? a, at - before);
    this.#drop(before);
  }

  /** Request the single face of the clock's time, without motion: it arrives long before the moving ones. */
  async #glance() {
    if (this.#glancing || !this.#connection.up) return;
    this.#glancing = true;
    const [{ take, rate }, frame] = [this.#held, this.#now()];
    // If this fails, the face comes with the others, or their request reports the error.
    await this.#connection.request("face_at", { take, time: frame / rate, still: true }).catch(() => {});
    this.#glancing = false;
    if (this.#take?.take === take && this.#now() !== frame && this.behind && !this.#clock.playing) this.#glance();
  }

  /** @param {number} wait */
  #later(wait) {
    clearTimeout(this.#retry);
    this.#retry = setTimeout(() => this.#ask(), wait);
  }

  /** Return the last frame at or before the clock's time. */
  #now() {
    return Math.floor(Math.min(this.#clock.time * this.#held.rate, this.#held.frames - 1));
  }

  /** @param {number} now */
  #drop(now) {
    const { rate } = this.#held;
    const [first, last] = [now - BEHIND * rate, now + 1.5 * AHEAD * rate];
    if (this.#faces.size < (BEHIND + 2 * AHEAD) * rate) return;
    for (const frame of this.#faces.keys()) if (frame < first || frame > last) this.#faces.delete(frame);
  }

  /**
   * Whether to wait for the current request: for a frame that is due soon, or the first one of the request, even if the
   * playhead has jumped since. A server that gets a request for each place of a scrub would never answer.
   * @param {number} frame @param {number} rate
   */
  #comes(frame, rate) {
    const asking = this.#asking;
    if (!asking || asking.arrived === asking.first) return asking !== null;
    return frame >= asking.first && frame < asking.last && frame <= asking.arrived + SOON * rate;
  }

  /** Request the first missing frames after the playhead, unless they are already requested. */
  #ask() {
    if (!this.#take || !this.#connection.up) return;
    if (!this.#clock.playing && performance.now() - this.#scrubbed < SETTLED) return;
    const { take, frames, rate } = this.#take;
    const now = this.#now();
    let first = now;
    while (first < frames && this.#faces.has(first)) first += 1;
    if (first >= frames || first - now > REFILL * rate) return;
    if (this.#comes(first, rate)) return;
    const asking = { first, last: Math.min(first + Math.ceil(AHEAD * rate), frames), arrived: first };
    this.#asking = asking;
    clearTimeout(this.#retry);
    const { last } = asking;
    const over = () => {
      if (this.#asking === asking) this.#asking = null;
    };
    this.#connection.request("faces", { take, first, last, pace: PACE * rate }).then(
      () => {
        over();
        this.#ask();
      },
      () => {
        over();
        this.#later(AGAIN);
      },
    );
  }
}
