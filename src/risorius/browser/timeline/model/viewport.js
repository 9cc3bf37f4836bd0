/**
 * The visible part of the take and its scale: converts seconds to pixels and back.
 */

const CLOSEST = 1200; // pixels a second at most: a frame of 30 fps is then 40 pixels wide
const MARGIN = 0.02; // s shown before the beginning
const ROOM = 40; // pixels beside a span that is scrolled into view
const READABLE = 14; // s shown of a longer take at first
const FOLLOWED = 0.82; // share of the width after which a playhead that is followed turns the page
const TURNED = 0.12; // where it stands after that

export class Viewport {
  start = 0;
  scale = 100;
  width = 1;
  duration = 1;

  /** Seconds shown. */
  get span() {
    return this.width / this.scale;
  }

  get end() {
    return this.start + this.span;
  }

  /** @param {number} time @returns {number} pixels from the left edge */
  x(time) {
    return (time - this.start) * this.scale;
  }

  /** @param {number} x pixels from the left edge @returns {number} seconds */
  time(x) {
    return this.start + x / this.scale;
  }

  /**
   * Set another width or duration; the time at the left edge stays.
   * @param {number} width @param {number} duration
   */
  resize(width, duration) {
    this.width = Math.max(width, 1);
    this.duration = duration;
    this.scale = Math.max(this.scale, this.#widest);
    this.scrollTo(this.start);
  }

  /** Show a new take: its beginning, at a readable scale. */
  open() {
    this.fit();
    if (this.span > READABLE) this.zoom(this.span / READABLE, 0);
    this.scrollTo(-MARGIN);
  }

  /** Show the whole take. */
  fit() {
    this.scale = this.#widest;
    this.scrollTo(-MARGIN);
  }

  /** @param {number} start */
  scrollTo(start) {
    const last = this.duration + MARGIN - this.span;
    this.start = Math.max(-MARGIN, Math.min(start, last));
  }

  /** Zoom in by a factor; the time at `x` stays. @param {number} factor @param {number} x */
  zoom(factor, x) {
    const held = this.time(x);
    this.scale = Math.max(this.#widest, Math.min(this.scale * factor, CLOSEST));
    this.scrollTo(held - x / this.scale);
  }

  /**
   * Scroll to a span of time unless it is visible.
   * @param {number} from @param {number} [to] @returns {boolean} whether anything moved
   */
  reveal(from, to = from) {
    const before = this.start;
    const room = Math.min(ROOM / this.scale, this.span / 4);
    if (from < this.start) this.scrollTo(from - room);
    else if (to > this.end) this.scrollTo(Math.min(from - room, to + room - this.span));
    return this.start !== before;
  }

  /** Turn the page when a playhead leaves it. @param {number} time @returns {boolean} whether anything moved */
  follow(time) {
    const before = this.start;
    const x = this.x(time);
    if (x < 0 || x > FOLLOWED * this.width) this.scrollTo(time - TURNED * this.span);
    return Math.abs(this.start - before) > 1e-9;
  }

  get #widest() {
    return this.width / (this.duration + 2 * MARGIN);
  }
}
