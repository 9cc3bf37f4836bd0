import { spoken } from "../dom.js";
import { DragKey, DragTangent, DrawKeys } from "./drawing.js";
import { DragEdge } from "./edges.js";
import { DragBlock, DragLoop, Pan, Scrub } from "./gestures.js";
import { DragBox, DragGroup, DragStretch } from "./group.js";
import { DragMarker } from "./markers.js";
import { clockTime } from "../paint/paint_head.js";
import { pick } from "./pick.js";
/** @import {Block, Found, Gesture, GraphRow} from "../../types.js" */
/** @import {TimelineController} from "../controller.js" */
/** @typedef {{add: (time: number, channel: string) => void, walk: () => void, note: (index: number) => void}} PointerParts */

/**
 * Pointer and wheel on the canvas.
 */

const CURSORS = ["ew-resize", "col-resize", "col-resize", "ew-resize"]; // of a block's handles
/** @type {Record<string, string>} */
const CURSOR_OF = {
  head: "text",
  grip: "ew-resize",
  marker: "grab",
  edge: "col-resize",
  key: "move",
  tangent: "move",
};
const WHEEL = 0.0022; // zoom by a wheel's pixel
const LINE = 16; // pixels of a wheel that reports lines
/** @type {Record<string, string>} */
const TITLES = {
  edge: "Drag to move this boundary; double-click to reset it",
  grip: "Drag to stretch the selection",
  marker: "Drag to move the marker; double-click to list all markers",
};
const STILL = 3; // pixels: less is a click

/**
 * @param {HTMLCanvasElement} canvas @param {import("../controller.js").TimelineController} controller
 * @param {PointerParts} parts
 *   `walk` moves the focus to the selected block in the list; `note` opens the editor of a marker's note
 */
export function listen(canvas, controller, parts) {
  const { walk } = parts;
  /** @type {Gesture | null} */
  let gesture = null;
  /** @type {{x: number, y: number, found: Found, still: boolean} | null} */
  let down = null;

  /** @param {MouseEvent} event @returns {[number, number]} */
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / controller.scene.unit, (event.clientY - box.top) / controller.scene.unit];
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (!controller.scene.model || event.button > 1) return;
    const [x, y] = place(event);
    const found = pick(controller.scene, x, y);
    down = { x, y, found, still: true };
    gesture = event.button === 1 ? new Pan(controller, x) : begun(controller, found, x, y, event);
    canvas.setPointerCapture(event.pointerId);
    if (found.kind === "block" || found.kind === "handle") walk();
    else canvas.focus({ preventScroll: true });
    event.preventDefault();
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!controller.scene.model) return;
    const [x, y] = place(event);
    if (down && Math.hypot(x - down.x, y - down.y) > STILL) down.still = false;
    if (gesture) gesture.move(x, y, event);
    else if (!down) hover(canvas, controller, pick(controller.scene, x, y));
  });
  canvas.addEventListener("pointerup", () => {
    gesture?.end();
    if (down?.still) clicked(controller, down.found);
    [gesture, down] = [null, null];
  });
  const cancel = () => {
    gesture?.cancel();
    [gesture, down] = [null, null];
  };
  canvas.addEventListener("pointercancel", cancel);
  // Whatever has the focus, Escape first cancels a drag.
  /** @param {KeyboardEvent} event */
  const giveUp = (event) => {
    if (event.key !== "Escape" || !gesture) return;
    cancel();
    event.stopPropagation();
  };
  document.addEventListener("keydown", giveUp, true);
  canvas.addEventListener("dblclick", (event) => doubled(controller, pick(controller.scene, ...place(event)), place(event), parts));
  canvas.addEventListener("wheel", (event) => wheeled(event, controller, place(event)[0]), { passive: false });
}

/**
 * @param {TimelineController} controller @param {Found} found @param {number} x @param {number} y
 * @param {PointerEvent} event @returns {Gesture | null}
 */
function begun(controller, found, x, y, event) {
  const more = event.shiftKey || event.ctrlKey || event.metaKey;
  switch (found.kind) {
    case "grip":
      return new DragStretch(controller, found.end);
    case "marker":
      return new DragMarker(controller, x, found.index);
    case "edge":
      return event.shiftKey ? new DragLoop(controller, x) : new DragEdge(controller, x, found.phone);
    case "head":
      return event.shiftKey ? new DragLoop(controller, x) : new Scrub(controller, x);
    case "block":
      return begunOnBlock(controller, found, x, more);
    case "handle":
      return new DragBlock(controller, x, found.block, found.handle);
    case "tangent":
      return new DragTangent(controller, found.row, found);
    case "key":
      controller.chooseKey(found.parameter, found.index);
      return new DragKey(controller, found.row, found.parameter, found.index);
    case "graph":
      return controller.draws || event.shiftKey ? new DrawKeys(controller, found.row, x, y) : null;
    default:
      return new DragBox(controller, x, y, more);
  }
}

/**
 * @param {TimelineController} controller @param {{block: Block, time: number}} found @param {number} x
 * @param {boolean} more whether it is added to the selection @returns {Gesture | null}
 */
function begunOnBlock(controller, { block, time }, x, more) {
  if (more && block.free) {
    controller.toggle(block);
    return null;
  }
  if (controller.scene.group.has(block.id)) return new DragGroup(controller, x, block);
  controller.choose(block, time);
  return block.free ? new DragBlock(controller, x, block, null) : null;
}

/** @param {TimelineController} controller @param {Found} found */
function clicked(controller, found) {
  if (found.kind === "graph" && !controller.draws) {
    const { row, time } = found;
    if (!controller.clock.playing) controller.clock.seek(time); // the face shows the explained moment
    controller.ask(time, row.names.length > 1 ? row.base : row.names[0]);
  }
  if (found.kind === "lane" || found.kind === "none") controller.choose(null);
}

/**
 * @param {TimelineController} controller @param {Found} found @param {[x: number, y: number]} place
 * @param {PointerParts} parts
 */
function doubled(controller, found, [x, y], { add, note }) {
  if (found.kind === "marker") note(found.index);
  if (found.kind === "head") controller.loopWord(found.time);
  if (found.kind === "edge") controller.actions.relabel(found.phone, null);
  if (found.kind === "lane" && found.row.lane.channel !== "lips" && !controller.locks(found.row.lane.channel)) add(found.time, found.row.lane.channel);
  if (found.kind === "graph" && !controller.draws) new DrawKeys(controller, found.row, x, y).end();
}

/** @param {HTMLCanvasElement} canvas @param {TimelineController} controller @param {Found} found */
function hover(canvas, controller, found) {
  const { scene } = controller;
  const block = "block" in found ? found.block : null;
  const hovered = block?.id ?? null;
  if (hovered !== scene.hovered) {
    scene.hovered = hovered;
    controller.repaint();
  }
  canvas.title = titleOf(controller, found, block);
  canvas.style.cursor = cursorOf(found, controller);
}

/** @param {TimelineController} controller @param {Found} found @param {Block | null} block */
function titleOf(controller, found, block) {
  const title = TITLES[found.kind];
  if (title) return title;
  if (block) return `${block.label || "silence"} (${block.channel})\n${block.cause}`;
  return found.kind === "graph" ? valueOf(controller, found.row, found.time) : "";
}

/**
 * Return the value under the pointer, and the channels that are inhibited or limited there.
 * @param {TimelineController} controller @param {GraphRow} row @param {number} time
 */
function valueOf({ scene: { model, details } }, row, time) {
  if (time < 0 || time > model.duration) return "";
  const [name] = row.names;
  const { unit } = model.parameter(name);
  const value = `${spoken(name)}: ${model.valueAt(name, time).toFixed(2)}${unit ? ` ${unit}` : ""} at ${clockTime(time)} s`;
  const held = /** @type {("inhibited" | "limited")[]} */ (["inhibited", "limited"]).flatMap((how) => {
    const there = (details.of(name)?.channels ?? []).filter((one) => one[how].some(([from, to]) => from <= time && time <= to));
    return there.map(({ channel }) => `\n${channel} is ${how}`);
  });
  return value + held.join("");
}

/** @param {Found} found @param {TimelineController} controller */
function cursorOf(found, controller) {
  if (found.kind === "handle") return CURSORS[found.handle];
  if (found.kind === "block") return found.block.free ? "grab" : "pointer";
  if (found.kind === "graph") return controller.draws ? "crosshair" : "help";
  return CURSOR_OF[found.kind] ?? "default";
}

/** @param {WheelEvent} event @param {TimelineController} controller @param {number} x */
function wheeled(event, controller, x) {
  const unit = event.deltaMode === 1 ? LINE : 1;
  if (event.ctrlKey || event.metaKey) {
    event.preventDefault();
    controller.zoom(Math.exp(-event.deltaY * unit * WHEEL), x);
    return;
  }
  const sideways = event.deltaX || (event.shiftKey ? event.deltaY : 0);
  if (!sideways) return;
  event.preventDefault();
  controller.scene.view.scrollTo(controller.scene.view.start + (sideways * unit) / controller.scene.view.scale);
  controller.repaint();
}
