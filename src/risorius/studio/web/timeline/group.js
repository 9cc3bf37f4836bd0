import { blockBand } from "./rows.js";
import { editOf, moved, nearest, snappedBy, timesOf } from "./times.js";

/**
 * Several movements that are selected together, and what is done to all of them: each is one change to undo.
 */

const SLACK = 3; // pixels that a pointer may tremble without dragging
const REACH = 7; // pixels within which a drag snaps

/** Blocks that a box in the scene's pixels touches; `y` counts from the top of the body. */
export function within(scene, { x0, y0, x1, y1 }) {
  const [from, to] = [Math.min(x0, x1), Math.max(x0, x1)].map((x) => scene.view.time(x));
  const [top, bottom] = [Math.min(y0, y1), Math.max(y0, y1)];
  const found = [];
  for (const row of scene.body) {
    if (row.kind !== "lane" || row.y > bottom || row.y + row.height < top) continue;
    for (const block of row.lane.spans.within(from, to)) {
      const [high, low] = blockBand(row, block);
      if (block.editable && low >= top && high <= bottom) found.push(block);
    }
  }
  return found;
}

/** The times of blocks moved together, as far as all stay in the take. */
export function movedTogether(all, delta, duration) {
  const [first, last] = [Math.min(...all.map(([start]) => start)), Math.max(...all.map((times) => times[3]))];
  const bound = Math.max(-first, Math.min(delta, Math.max(duration - last, -first)));
  return all.map((times) => times.map((time) => time + bound));
}

/** The wire's edits that move blocks to other times. */
export function editsOf(blocks, after) {
  const edits = blocks.map((block, k) => [block, editOf(timesOf(block), after[k])]);
  return edits
    .filter(([, edit]) => edit !== null)
    .map(([block, { kind, fields }]) => ({ kind, movement: block.id, ...fields }));
}

/** Move all that is selected; snaps as the block that is dragged does. */
export class DragGroup {
  #controller;
  #block;
  #blocks;
  #from;
  #x;
  #dragging = false;

  constructor(controller, x, block) {
    this.#controller = controller;
    this.#block = block;
    this.#blocks = controller.blocks;
    this.#from = this.#blocks.map((one) => timesOf(controller.edits.shown(one) ?? one));
    this.#x = x;
  }

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

  constructor(controller, x, y, add) {
    this.#controller = controller;
    this.#from = [x, this.#depth(y)];
    this.#before = add ? controller.blocks : [];
  }

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

  #depth(y) {
    const { scene } = this.#controller;
    return y - scene.headHeight + scene.scroll;
  }
}
