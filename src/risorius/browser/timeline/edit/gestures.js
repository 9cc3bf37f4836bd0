import { moved, nearest, pulled, snappedBy, timesOf } from "../model/times.js";
/** @import {Block} from "../../types.js" */
/** @import {TimelineController} from "../controller.js" */

/**
 * Pointer gestures, from button down to button up. Each one has `move(x, y, event)`, `end()` and `cancel()`.
 *
 * `controller` is the timeline's own: {scene, edits, clock, actions, snaps, repaint, choose}.
 */

const REACH = 7; // pixels within which an edit snaps
const SLACK = 3; // pixels that a pointer may move without dragging

/** Move the playhead; the sound pauses meanwhile. */
export class Scrub {
  #controller;
  #played;

  /** @param {TimelineController} controller @param {number} x */
  constructor(controller, x) {
    this.#controller = controller;
    this.#played = controller.clock.playing;
    controller.clock.pause();
    this.move(x);
  }

  /** @param {number} x */
  move(x) {
    this.#controller.clock.seek(this.#controller.scene.view.time(x));
  }

  end() {
    if (this.#played) this.#controller.clock.play();
  }

  cancel() {
    this.end();
  }
}

/** Choose the loop range. */
export class DragLoop {
  #controller;
  #from;
  #before;

  /** @param {TimelineController} controller @param {number} x */
  constructor(controller, x) {
    this.#controller = controller;
    this.#from = controller.scene.view.time(x);
    this.#before = controller.clock.loop;
  }

  /** @param {number} x */
  move(x) {
    const { view, model } = this.#controller.scene;
    const [one, other] = [this.#from, view.time(x)].map((time) => Math.max(0, Math.min(time, model.duration)));
    this.#controller.clock.setLoop([Math.min(one, other), Math.max(one, other)]);
  }

  end() {}

  cancel() {
    this.#controller.clock.setLoop(this.#before);
  }
}

/** Scroll sideways. */
export class Pan {
  #controller;
  #held;

  /** @param {TimelineController} controller @param {number} x */
  constructor(controller, x) {
    this.#controller = controller;
    this.#held = controller.scene.view.time(x);
  }

  /** @param {number} x */
  move(x) {
    const { view } = this.#controller.scene;
    view.scrollTo(this.#held - x / view.scale);
    this.#controller.repaint();
  }

  end() {}

  cancel() {}
}

/** Move a block, or change one of its times: start, end of onset, start of offset, end. */
export class DragBlock {
  #controller;
  #block;
  #handle;
  #from;
  #x;
  #dragging = false;

  /**
   * @param {TimelineController} controller @param {number} x @param {Block} block
   * @param {number | null} handle null moves the whole block
   */
  constructor(controller, x, block, handle) {
    this.#controller = controller;
    this.#block = block;
    this.#handle = handle;
    this.#from = timesOf(controller.edits.shown(block) ?? block);
    this.#x = x;
  }

  /** @param {number} x @param {number} y @param {PointerEvent} event */
  move(x, y, event) {
    if (!this.#dragging && Math.abs(x - this.#x) < SLACK) return;
    this.#dragging = true;
    const { scene, edits } = this.#controller;
    const reach = this.#controller.snaps !== event.altKey ? REACH / scene.view.scale : 0;
    const times = this.#handle === null ? this.#moved(x, reach) : this.#pulled(x, reach);
    edits.hold(this.#block, times);
  }

  /** @param {number} x @param {number} reach */
  #moved(x, reach) {
    const { scene } = this.#controller;
    const { duration, edges } = scene.model;
    const times = moved(this.#from, (x - this.#x) / scene.view.scale, duration);
    const way = reach ? snappedBy(edges, times, reach) : 0;
    const there = moved(times, way, duration);
    scene.guide = way ? [there[0], there[3]].find((time) => nearest(edges, time, 1e-6) !== null) ?? null : null;
    return there;
  }

  /** @param {number} x @param {number} reach */
  #pulled(x, reach) {
    const { scene } = this.#controller;
    const { duration, edges } = scene.model;
    const handle = this.#handle ?? 0;
    const time = this.#from[handle] + (x - this.#x) / scene.view.scale;
    const edge = reach ? nearest(edges, time, reach) : null;
    scene.guide = edge;
    return pulled(this.#from, handle, edge ?? time, duration);
  }

  end() {
    this.#controller.scene.guide = null;
    if (this.#dragging) this.#controller.edits.send(this.#block);
    this.#controller.repaint();
  }

  cancel() {
    this.#controller.scene.guide = null;
    this.#controller.edits.drop(this.#block.id);
  }
}
