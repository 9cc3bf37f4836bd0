/**
 * Time of the performance: the sound's own while it plays, so that picture and sound cannot drift apart.
 *
 * An audio element's time is that of the sound being heard: browsers subtract the latency that the output reports
 * (docs/studio.md lists the sources). `AudioContext.outputLatency` is for Web Audio's clock; subtracted here, it
 * would count twice. `delay` compensates for headphones that report less than their real latency.
 *
 * Without a sound, and beyond its end, the page's time runs instead. `on("tick", call)` reports the time on
 * every animation frame on which it may have changed, `on("state", call)` changes of playing, speed and loop.
 */

const JUMP = 0.08; // difference in s between sound and shown time at which the shown time jumps
const LONGEST = 1500; // ms to wait for sound and face before time runs without them
const LATEST = 1; // s by which sound may be late
const KEY = "risorius-sound-delay";
const PULL = 0.15; // s in which a smaller difference shrinks to a third

export class Clock {
  #audio = new Audio();
  #silent = true;
  #asked = 0; // when playing was requested, while it waits for sound and face
  /** @type {string | null} */
  #address = null;
  #time = 0;
  #seen = 0;
  #begun = 0; // where the sound was started
  #delay = kept();
  #playing = false;
  #rate = 1;
  /** @type {[number, number] | null} */
  #loop = null;
  #calls = { tick: new Set(), state: new Set() };

  /** Whether the face of this time has arrived: time starts when it and the sound have. */
  seen = () => true;
  /** Seconds of the take. */
  duration = 0;
  /** Frames per second of the take. */
  fps = 30;

  constructor() {
    this.#audio.preservesPitch = true;
    this.#audio.preload = "auto";
    for (const name of ["canplay", "seeked"]) this.#audio.addEventListener(name, () => this.begin());
  }

  /** Seconds from the first sample of the sound. */
  get time() {
    return this.#time;
  }

  get playing() {
    return this.#playing;
  }

  /** The position of the sound being heard, in seconds; null if there is no sound. */
  get sounding() {
    return this.#silent || this.#audio.paused ? null : this.#audio.currentTime;
  }

  /** Latency of the sound in seconds beyond what the browser reports; stored in this browser. */
  get delay() {
    return this.#delay;
  }

  set delay(delay) {
    this.#delay = Math.min(Math.max(delay, 0), LATEST);
    localStorage.setItem(KEY, String(this.#delay));
  }

  /** Speed, 1 as recorded. */
  get rate() {
    return this.#rate;
  }

  /** The loop range [from, to] in seconds, or null. */
  get loop() {
    return this.#loop;
  }

  /** @param {"tick" | "state"} name @param {(clock: Clock) => void} call @returns {() => void} ends it */
  on(name, call) {
    this.#calls[name].add(call);
    return () => this.#calls[name].delete(call);
  }

  /**
   * Switch to another take; the time stays, limited to the take.
   * @param {{duration: number, fps: number, sound: string | null}} take `sound` is an address
   */
  load({ duration, fps, sound }) {
    this.duration = duration;
    this.fps = fps;
    if (sound !== this.#address) this.#fetch(sound);
    if (this.#loop) this.#loop = [Math.min(this.#loop[0], duration), Math.min(this.#loop[1], duration)];
    this.#time = Math.min(this.#time, duration);
    if (duration === 0) this.pause();
    this.#tell("state");
    this.#tell("tick");
  }

  /** Load the whole sound, so that it can start anywhere at once. @param {string | null} address */
  async #fetch(address) {
    this.#address = address;
    this.#silent = true;
    this.#audio.pause();
    if (address === null) return;
    if (this.#playing) this.#await();
    const response = await fetch(address);
    if (!response.ok || address !== this.#address) return;
    const blob = await response.blob();
    if (address !== this.#address) return;
    URL.revokeObjectURL(this.#audio.src);
    this.#audio.src = URL.createObjectURL(blob);
    this.#audio.currentTime = this.#time;
    this.#silent = false;
  }

  /** Start the next take at its beginning; listeners are called when it has arrived. */
  rewind() {
    this.#time = 0;
  }

  /** @param {number} time seconds, brought within the take */
  seek(time) {
    this.#time = Math.min(Math.max(time, 0), this.duration);
    if (this.#playing) this.#cue();
    this.#seen = performance.now();
    this.#tell("tick");
  }

  /** Go to a frame's time, `count` frames on; pauses. @param {number} count */
  step(count) {
    this.pause();
    const frame = Math.round(this.#time * this.fps) + count;
    this.seek(frame / this.fps);
  }

  play() {
    if (this.duration === 0) return;
    const [from, to] = this.#bounds();
    if (this.#time >= to - 0.5 / this.fps || this.#time < from) this.seek(from);
    this.#playing = true;
    this.#await();
    this.#tell("state");
    requestAnimationFrame(() => this.#run());
  }

  /** Start the time if playing was requested and sound and face have arrived. */
  begin() {
    if (!this.#playing || !this.#asked) return;
    if ((this.#ready && this.seen()) || performance.now() - this.#asked > LONGEST) this.#start();
  }

  /** Whether there is no sound, or one that can be heard at once. */
  get #ready() {
    return this.#address === null || (!this.#silent && !this.#audio.seeking && this.#audio.readyState >= 3);
  }

  /** Hold the time until sound and face can start together. */
  #await() {
    this.#asked = performance.now();
    this.#cue();
    this.begin();
  }

  pause() {
    if (!this.#playing) return;
    this.#playing = false;
    this.#audio.pause();
    this.#tell("state");
  }

  /** @param {number} rate 0.1 to 2 */
  setRate(rate) {
    this.#rate = rate;
    this.#audio.playbackRate = rate;
    this.#tell("state");
  }

  /** @param {[number, number] | null} loop seconds */
  setLoop(loop) {
    this.#loop = loop && loop[1] - loop[0] > 1 / this.fps ? loop : null;
    this.#tell("state");
  }

  #bounds() {
    return this.#loop ?? [0, this.duration];
  }

  /** Seek the sound to the time, only when it starts: seeking takes long in a long line. */
  #cue() {
    this.#begun = this.#time;
    if (!this.#silent && this.#audio.currentTime !== this.#time) this.#audio.currentTime = this.#time;
  }

  #start() {
    this.#asked = 0;
    this.#seen = performance.now();
    if (this.#silent) return;
    this.#cue();
    this.#audio.playbackRate = this.#rate;
    // Browsers refuse this before the page is touched: then time runs without sound.
    this.#audio.play().catch(() => {});
  }

  #run() {
    if (!this.#playing) return;
    this.begin();
    if (!this.#asked) this.#advance();
    this.#tell("tick");
    if (this.#playing) requestAnimationFrame(() => this.#run());
  }

  #advance() {
    const now = performance.now();
    const elapsed = (now - this.#seen) / 1000;
    this.#seen = now;
    this.#time = this.#heard(this.#time + elapsed * this.#rate, elapsed);
    const [from, to] = this.#bounds();
    if (this.#time >= to) this.#reachedEnd(from, to);
  }

  /**
   * Return the time by the sound if it plays, interpolated between its coarse reports.
   * @param {number} guess @param {number} elapsed
   */
  #heard(guess, elapsed) {
    const audio = this.#audio;
    if (this.#silent || audio.paused || audio.ended || audio.readyState < 3) return guess;
    const heard = Math.max(audio.currentTime - this.#delay * this.#rate, this.#begun);
    const ahead = heard - guess;
    return Math.abs(ahead) > JUMP ? heard : guess + ahead * (1 - Math.exp(-elapsed / PULL));
  }

  /** @param {number} from @param {number} to */
  #reachedEnd(from, to) {
    if (this.#loop) {
      this.seek(from);
      this.#start();
      return;
    }
    this.#time = to;
    this.pause();
  }

  /** @param {"tick" | "state"} name */
  #tell(name) {
    for (const call of [...this.#calls[name]]) call(this);
  }
}

function kept() {
  const delay = Number(localStorage.getItem(KEY));
  return delay > 0 && delay <= LATEST ? delay : 0;
}
