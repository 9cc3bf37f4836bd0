import { blockBand } from "../model/rows.js";
import { editOf, moved, nearest, snappedBy, stretchTo, stretchedTogether, timesOf } from "../model/times.js";
/** @import {Block, Box, SpeechRow, Times} from "../../types.js" */
/** @import {TimelineController} from "../controller.js" */
/** @import {Scene} from "../paint/scene.js" */

/**
 * Edits of several selected movements: each edit is one step to undo.
 */

const SLACK = 3; // pixels that a pointer may move without dragging
const REACH = 7; // pixels within which a drag snaps

/**
 * Blocks that a box in the scene's pixels touches; `y` counts from the top of the body.
 * @param {Scene} scene @param {Box} box @returns {Block[]}
 */
export function within(scene, { x0, y0, x1, y1 }) {
  const [from, to] = [Math.min(x0, x1), Math.max(x0, x1)].map((x) => scene.view.time(x));
  const [top, bottom] = [Math.min(y0, y1), Math.max(y0, y1)];
  const found = [];
  for (const row of scene.body) {
    if (row.kind !== "lane" || row.y > bottom || row.y + row.height < top) continue;
    for (const block of row.lane.spans.within(from, to)) {
      const [high, low] = blockBand(row, block);
      if (block.free && low >= top && high <= bottom) found.push(block);
    }
  }
  return found;
}

/**
 * Return the times of blocks moved together; the shift is limited so that all stay in the take.
 * @param {Times[]} all @param {number} delta @param {number} duration @returns {Times[]}
 */
export function movedTogether(all, delta, duration) {
  const [first, last] = [Math.min(...all.map(([start]) => start)), Math.max(...all.map((times) => times[3]))];
  const bound = Math.max(-first, Math.min(delta, Math.max(duration - last, -first)));
  return all.map((times) => times.map((time) => time + bound));
}

/** Return the wire's edits that change the times of blocks. @param {Block[]} blocks @param {Times[]} after */
export function editsOf(blocks, after) {
  return blocks.flatMap((block, k) => {
    const edit = editOf(timesOf(block), after[k]);
    if (edit === null) return [];
    const { kind, fields } = edit.kind === "move" ? edit : stretchTo(after[k]);
    return [{ kind, movement: block.id, ...fields }];
  });
}

/**
 * Return the shown start of the first and end of the last selected movement; null if fewer than two are selected.
 * @param {Pick<Scene, "group" | "model" | "edits">} scene @returns {[number, number] | null}
 */
export function spanOf({ group, model, edits }) {
  if (!model || group.size < 2) return null;
  const shown = [...group].flatMap((id) => model.blocks.get(id) ?? []).map((block) => edits.shown(block) ?? block);
  return [Math.min(...shown.map(({ start }) => start)), Math.max(...shown.map(({ end }) => end))];
}

const GRIP = 4; // half the size of a handle

/**
 * Return which end of the selection's bar on the ruler is at a place: 0 start, 1 end, -1 neither.
 * @param {Scene} scene @param {SpeechRow | null} row @param {number} x @param {number} y
 */
export function gripNear(scene, row, x, y) {
  const span = row?.kind === "ruler" ? spanOf(scene) : null;
  if (!row || !span || y < row.y + row.height / 2) return -1;
  return span.findIndex((time) => Math.abs(scene.view.x(time) - x) <= 2 * GRIP);
}

/** Draw a bar on the ruler over the selection: dragging its ends stretches the selection. @param {Scene} scene @param {SpeechRow} row */
export function paintSpan(scene, row) {
  const span = spanOf(scene);
  if (!span) return;
  const { context, view, palette } = scene;
  const [left, right] = span.map((time) => view.x(time));
  const y = row.y + row.height - 5;
  context.fillStyle = palette.mark;
  context.fillRect(left, y - 1, right - left, 3);
  for (const x of [left, right]) context.fillRect(x - GRIP, y - GRIP, 2 * GRIP, 2 * GRIP);
}

/** Stretch the selection, with onsets and offsets; the other end stays. */
export class DragStretch {
  #controller;
  #blocks;
  #from;
  #ends;
  /** @type {number | null} */
  #time = null;

  /** @param {TimelineController} controller @param {number} end which end is dragged: 0 the first start, 1 the last end */
  constructor(controller, end) {
    this.#controller = controller;
    this.#blocks = controller.blocks;
    this.#from = this.#blocks.map((one) => timesOf(controller.edits.shown(one) ?? one));
    const span = spanOf(controller.scene) ?? [0, 0];
    this.#ends = [span[1 - end], span[end]];
  }

  /** @param {number} x @param {number} y @param {PointerEvent} event */
  move(x, y, event) {
    const { scene, edits, snaps } = this.#controller;
    const { duration, edges } = scene.model;
    const time = scene.view.time(x);
    const edge = snaps !== event.altKey ? nearest(edges, time, REACH / scene.view.scale) : null;
    scene.guide = edge;
    this.#time = edge ?? time;
    edits.holdAll(this.#blocks, stretchedTogether(this.#from, this.#ends[0], this.#ends[1], this.#time, duration));
  }

  end() {
    this.#controller.scene.guide = null;
    if (this.#time !== null) this.#controller.edits.sendAll(this.#blocks);
    this.#controller.repaint();
  }

  cancel() {
    this.#controller.scene.guide = null;
    for (const { id } of this.#blocks) this.#controller.edits.drop(id);
  }
}

/** Move the selection; it snaps with the dragged block. */
export class DragGroup {
  #controller;
  #block;
  #blocks;
  #from;
  #x;
  #dragging = false;

  /** @param {TimelineController} controller @param {number} x @param {Block} block */
  constructor(controller, x, block) {
    this.#controller = controller;
    this.#block = block;
    this.#blocks = controller.blocks;
    this.#from = this.#blocks.map((one) => timesOf(controller.edits.shown(one) ?? one));
    this.#x = x;
  }

  /** @param {number} x @param {number} y @param {PointerEvent} event */
  move(x, y, event) {
    if (!this.#dragging && Math.abs(x - this.#x) < SLACK) return;
    this.#dragging = true;
    const { scene, edits } = this.#controller;
    const { duration, edges } = scene.model;
    let delta = (x - this.#x) / scene.view.scale;
    scene.guide = null;
    if (this.#controller.snaps !== event.altKey) {
      const own = moved(this.#from[this.#blocks.indexOf(this.#block)], delta, duration);
      const way = snappedBy(edges, own, REACH / scene.view.scale);
      const ends = [own[0] + way, own[3] + way];
      scene.guide = way ? (ends.find((time) => nearest(edges, time, 1e-6) !== null) ?? null) : null;
      delta += way;
    }
    edits.holdAll(this.#blocks, movedTogether(this.#from, delta, duration));
  }

  end() {
    this.#controller.scene.guide = null;
    if (this.#dragging) this.#controller.edits.sendAll(this.#blocks);
    else this.#controller.choose(this.#block);
    this.#controller.repaint();
  }

  cancel() {
    this.#controller.scene.guide = null;
    for (const { id } of this.#blocks) this.#controller.edits.drop(id);
  }
}

/** Select all movements in a box. */
export class DragBox {
  #controller;
  #from;
  #before;

  /** @param {TimelineController} controller @param {number} x @param {number} y @param {boolean} add */
  constructor(controller, x, y, add) {
    this.#controller = controller;
    this.#from = [x, this.#depth(y)];
    this.#before = add ? controller.blocks : [];
  }

  /** @param {number} x @param {number} y */
  move(x, y) {
    const { scene } = this.#controller;
    const [x0, y0] = this.#from;
    const box = { x0, y0, x1: x, y1: this.#depth(y) };
    if (scene.box === null && Math.hypot(box.x1 - x0, box.y1 - y0) < SLACK) return;
    scene.box = box;
    this.#controller.chooseAll([...this.#before, ...within(scene, box)]);
  }

  end() {
    this.#controller.scene.box = null;
    this.#controller.repaint();
  }

  cancel() {
    this.#controller.chooseAll(this.#before);
    this.end();
  }

  /** @param {number} y */
  #depth(y) {
    const { scene } = this.#controller;
    return y - scene.headHeight + scene.scroll;
  }
}
