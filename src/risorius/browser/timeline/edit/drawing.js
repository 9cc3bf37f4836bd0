import { withHandle } from "../model/key_shapes.js";
import { withKey, withLine, withMoved } from "../model/keys.js";
import { scaleOf } from "../paint/paint_graphs.js";
/** @import {GraphRow} from "../../types.js" */
/** @import {TimelineController} from "../controller.js" */

/**
 * Pointer gestures on graphs (as in `gestures.js`): dragging and drawing keys.
 */

const FINE = 0.012; // tolerance for simplifying a freehand line, as a share of the graph's height

/** Drag a key of a graph. */
export class DragKey {
  #controller;
  #row;
  #parameter;
  #index;
  #keys;
  #dragging = false;

  /** @param {TimelineController} controller @param {GraphRow} row @param {string} parameter @param {number} index */
  constructor(controller, row, parameter, index) {
    this.#controller = controller;
    this.#row = row;
    this.#parameter = parameter;
    this.#index = index;
    this.#keys = controller.edits.keys(parameter);
  }

  /** @param {number} x @param {number} y */
  move(x, y) {
    const { scene, edits } = this.#controller;
    this.#dragging = true;
    const value = scaleOf(scene.model, this.#row).value(y - scene.headHeight + scene.scroll);
    const keys = withMoved(this.#keys, this.#index, scene.view.time(x), value, scene.model.duration);
    edits.holdKeys(this.#names, keys);
  }

  /** Return both sides if they have the same keys, so that they stay the same. */
  get #names() {
    /** @param {string} name */
    const same = (name) => JSON.stringify(this.#controller.edits.keys(name)) === this.#before;
    return this.#row.names.filter((name) => name === this.#parameter || same(name));
  }

  get #before() {
    return JSON.stringify(this.#controller.edits.keys(this.#parameter));
  }

  end() {
    if (this.#dragging) this.#controller.edits.sendKeys(this.#names, this.#controller.edits.keys(this.#parameter));
  }

  cancel() {
    this.#controller.edits.dropKeys(this.#names);
  }
}

/** Drag a handle of a key; with Alt the opposite handle stays. */
export class DragTangent {
  #controller;
  #row;
  #found;
  #names;
  #keys;
  #dragging = false;

  /**
   * @param {TimelineController} controller @param {GraphRow} row
   * @param {{parameter: string, index: number, side: "before" | "after"}} found
   */
  constructor(controller, row, found) {
    this.#controller = controller;
    this.#row = row;
    this.#found = found;
    this.#keys = controller.edits.keys(found.parameter);
    this.#names = controller.partners(found.parameter).filter((name) => row.names.includes(name));
  }

  /** @param {number} x @param {number} y @param {PointerEvent} event */
  move(x, y, event) {
    const { scene, edits } = this.#controller;
    const { index, side } = this.#found;
    const [time, value] = this.#keys[index];
    const high = scaleOf(scene.model, this.#row).value(y - scene.headHeight + scene.scroll);
    /** @type {[number, number]} */
    const handle = [scene.view.time(x) - time, high - value];
    this.#dragging = true;
    edits.holdKeys(this.#names, withHandle(this.#keys, index, side, handle, event.altKey));
  }

  end() {
    const { edits } = this.#controller;
    if (this.#dragging) edits.sendKeys(this.#names, edits.keys(this.#found.parameter));
  }

  cancel() {
    this.#controller.edits.dropKeys(this.#names);
  }
}

/** Draw a freehand curve; a click sets one key. */
export class DrawKeys {
  #controller;
  #row;
  /** @type {[time: number, value: number][]} */
  #line = [];
  #kept;

  /** @param {TimelineController} controller @param {GraphRow} row @param {number} x @param {number} y */
  constructor(controller, row, x, y) {
    this.#controller = controller;
    this.#row = row;
    this.#kept = controller.edits.keys(row.names[0]);
    this.move(x, y);
  }

  /** @param {number} x @param {number} y */
  move(x, y) {
    const { scene, edits } = this.#controller;
    const time = Math.max(0, Math.min(scene.view.time(x), scene.model.duration));
    const value = scaleOf(scene.model, this.#row).value(y - scene.headHeight + scene.scroll);
    this.#line = [...this.#line.filter(([other]) => Math.abs(other - time) > 0.5 / scene.view.scale), [time, value]];
    edits.holdKeys(this.#row.names, this.#drawn);
  }

  get #drawn() {
    const { model } = this.#controller.scene;
    const around = model.around(this.#row.names[0]);
    if (this.#line.length === 1) return withKey(this.#kept, this.#line[0][0], this.#line[0][1], around);
    const { least, most } = scaleOf(model, this.#row);
    return withLine(this.#kept, this.#line, FINE * (most - least), around);
  }

  end() {
    this.#controller.edits.sendKeys(this.#row.names, this.#drawn);
  }

  cancel() {
    this.#controller.edits.dropKeys(this.#row.names);
  }
}
