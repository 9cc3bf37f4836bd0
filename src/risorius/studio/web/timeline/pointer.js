import { spoken } from "./dom.js";
import { DragKey, DragTangent, DrawKeys } from "./drawing.js";
import { DragEdge } from "./edges.js";
import { DragBlock, DragLoop, Pan, Scrub } from "./gestures.js";
import { DragBox, DragGroup, DragStretch } from "./group.js";
import { DragMarker } from "./markers.js";
import { clockTime } from "./paint_head.js";
import { pick } from "./pick.js";

/**
 * Pointer and wheel on the canvas.
 */

const CURSORS = ["ew-resize", "col-resize", "col-resize", "ew-resize"];
const WHEEL = 0.0022; // zoom by a wheel's pixel
const LINE = 16; // pixels of a wheel that reports lines
const TITLES = {
  edge: "Drag to correct where it begins; a double click puts it back",
  grip: "Drag to stretch all that is selected",
  marker: "Drag to move the marker; a double click lists all markers and their notes",
};
const STILL = 3; // pixels: less is a click

/**
 * @param {HTMLCanvasElement} canvas @param {import("./controller.js").TimelineController} controller
 * @param {{add: (time: number, channel: string) => void, walk: () => void, note: (index: number) => void}} parts
 *   `walk` gives the keys to the list of blocks, at the one that is selected; `note` has a marker's note typed
 */
export function listen(canvas, controller, parts) {
  const { walk } = parts;
  let gesture = null;
  let down = null;

  /** @returns {[number, number]} */
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
  // Whatever has the keyboard: a drag is given up before anything else is.
  const giveUp = (event) => {
    if (event.key !== "Escape" || !gesture) return;
    cancel();
    event.stopPropagation();
  };
  document.addEventListener("keydown", giveUp, true);
  canvas.addEventListener("dblclick", (event) => doubled(controller, pick(controller.scene, ...place(event)), place(event), parts));
  canvas.addEventListener("wheel", (event) => wheeled(event, controller, place(event)[0]), { passive: false });
}

function begun(controller, found, x, y, event) {
  const { kind, block, handle, row, parameter, index } = found;
  if (kind === "grip") return new DragStretch(controller, found.end);
  if (kind === "marker") return new DragMarker(controller, x, index);
  if (kind === "edge" && !event.shiftKey) return new DragEdge(controller, x, found.phone);
  if (kind === "head" || kind === "edge") return event.shiftKey ? new DragLoop(controller, x) : new Scrub(controller, x);
  const more = event.shiftKey || event.ctrlKey || event.metaKey;
  if (kind === "block" && more && block.free) {
    controller.toggle(block);
    return null;
  }
  if (kind === "block" && controller.scene.group.has(block.id)) return new DragGroup(controller, x, block);
  if (kind === "lane" || kind === "none") return new DragBox(controller, x, y, more);
  if (kind === "handle") return new DragBlock(controller, x, block, handle);
  if (kind === "block") {
    controller.choose(block, found.time);
    return block.free ? new DragBlock(controller, x, block, null) : null;
  }
  if (kind === "tangent") return new DragTangent(controller, row, found);
  if (kind === "key") {
    controller.chooseKey(parameter, index);
    return new DragKey(controller, row, parameter, index);
  }
  if (kind === "graph" && (controller.draws || event.shiftKey)) return new DrawKeys(controller, row, x, y);
  return null;
}

function clicked(controller, { kind, row, time }) {
  if (kind === "graph" && !controller.draws) {
    if (!controller.clock.playing) controller.clock.seek(time); // the face shows what is explained
    controller.ask(time, row.names.length > 1 ? row.base : row.names[0]);
  }
  if (kind === "lane" || kind === "none") controller.choose(null);
}

function doubled(controller, found, [x, y], { add, note }) {
  if (found.kind === "marker") note(found.index);
  if (found.kind === "head") controller.loopWord(found.time);
  if (found.kind === "edge") controller.actions.relabel(found.phone, null);
  if (found.kind === "lane" && found.row.lane.channel !== "lips" && !controller.locks(found.row.lane.channel)) add(found.time, found.row.lane.channel);
  if (found.kind === "graph" && !controller.draws) new DrawKeys(controller, found.row, x, y).end();
}

function hover(canvas, controller, found) {
  const { kind, block, handle, row, time } = found;
  const { scene } = controller;
  const hovered = block?.id ?? null;
  if (hovered !== scene.hovered) {
    scene.hovered = hovered;
    controller.repaint();
  }
  if (kind in TITLES) canvas.title = TITLES[kind];
  else canvas.title = block ? `${block.label || "silence"} (${block.channel})\n${block.cause}` : valueOf(controller, kind, row, time);
  canvas.style.cursor = cursorOf(kind, handle, block, controller);
}

/** The value under the pointer, and which channels are held back there. */
function valueOf({ scene: { model, details } }, kind, row, time) {
  if (kind !== "graph" || time < 0 || time > model.duration) return "";
  const [name] = row.names;
  const { unit } = model.parameters.get(name);
  const value = `${spoken(name)}: ${model.valueAt(name, time).toFixed(2)}${unit ? ` ${unit}` : ""} at ${clockTime(time)} s`;
  const held = ["inhibited", "limited"].flatMap((how) => {
    const there = (details.of(name)?.channels ?? []).filter((one) => one[how].some(([from, to]) => from <= time && time <= to));
    return there.map(({ channel }) => `\n${channel} is ${how}`);
  });
  return value + held.join("");
}

function cursorOf(kind, handle, block, controller) {
  if (kind === "handle") return CURSORS[handle];
  if (kind === "head") return "text";
  if (kind === "grip") return "ew-resize";
  if (kind === "marker") return "grab";
  if (kind === "edge") return "col-resize";
  if (kind === "block") return block.free ? "grab" : "pointer";
  if (kind === "graph") return controller.draws ? "crosshair" : "help";
  return kind === "key" || kind === "tangent" ? "move" : "default";
}

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
