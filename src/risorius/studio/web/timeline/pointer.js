import { spoken } from "./dom.js";
import { DragKey, DrawKeys } from "./drawing.js";
import { DragBlock, DragLoop, Pan, Scrub } from "./gestures.js";
import { clockTime } from "./paint_head.js";
import { pick } from "./pick.js";

/**
 * Pointer and wheel on the canvas.
 */

const CURSORS = ["ew-resize", "col-resize", "col-resize", "ew-resize"];
const WHEEL = 0.0022; // zoom by a wheel's pixel
const LINE = 16; // pixels of a wheel that reports lines
const STILL = 3; // pixels: less is a click

/**
 * @param {HTMLCanvasElement} canvas @param {import("./desk.js").Desk} desk
 * @param {{add: (time: number, channel: string) => void, walk: () => void}} parts `walk` gives the keys to the
 *   list of blocks, at the one that is selected
 */
export function listen(canvas, desk, { add, walk }) {
  let gesture = null;
  let down = null;

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / desk.scene.unit, (event.clientY - box.top) / desk.scene.unit];
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (!desk.scene.model || event.button > 1) return;
    const [x, y] = place(event);
    const found = pick(desk.scene, x, y);
    down = { x, y, found, still: true };
    gesture = event.button === 1 ? new Pan(desk, x) : begun(desk, found, x, y, event);
    canvas.setPointerCapture(event.pointerId);
    if (found.kind === "block" || found.kind === "handle") walk();
    else canvas.focus({ preventScroll: true });
    event.preventDefault();
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!desk.scene.model) return;
    const [x, y] = place(event);
    if (down && Math.hypot(x - down.x, y - down.y) > STILL) down.still = false;
    if (gesture) gesture.move(x, y, event);
    else if (!down) hover(canvas, desk, pick(desk.scene, x, y));
  });
  canvas.addEventListener("pointerup", () => {
    gesture?.end();
    if (down?.still) clicked(desk, down.found);
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
  canvas.addEventListener("dblclick", (event) => doubled(desk, pick(desk.scene, ...place(event)), place(event), add));
  canvas.addEventListener("wheel", (event) => wheeled(event, desk, place(event)[0]), { passive: false });
}

function begun(desk, found, x, y, event) {
  const { kind, block, handle, row, parameter, index } = found;
  if (kind === "head") return event.shiftKey ? new DragLoop(desk, x) : new Scrub(desk, x);
  if (kind === "handle") return new DragBlock(desk, x, block, handle);
  if (kind === "block") {
    desk.choose(block, found.time);
    return block.editable ? new DragBlock(desk, x, block, null) : null;
  }
  if (kind === "key") {
    desk.chooseKey(parameter, index);
    return new DragKey(desk, row, parameter, index);
  }
  if (kind === "graph" && (desk.draws || event.shiftKey)) return new DrawKeys(desk, row, x, y);
  return null;
}

function clicked(desk, { kind, row, time }) {
  if (kind === "graph" && !desk.draws) {
    if (!desk.clock.playing) desk.clock.seek(time); // the face shows what is explained
    desk.ask(time, row.names.length > 1 ? row.base : row.names[0]);
  }
  if (kind === "lane" || kind === "none") desk.choose(null);
}

function doubled(desk, found, [x, y], add) {
  if (found.kind === "head") desk.loopWord(found.time);
  if (found.kind === "lane" && found.row.lane.channel !== "lips") add(found.time, found.row.lane.channel);
  if (found.kind === "graph" && !desk.draws) new DrawKeys(desk, found.row, x, y).end();
}

function hover(canvas, desk, { kind, block, handle, row, time }) {
  const { scene } = desk;
  const hovered = block?.id ?? null;
  if (hovered !== scene.hovered) {
    scene.hovered = hovered;
    desk.repaint();
  }
  canvas.title = block ? `${block.label || "silence"} (${block.channel})\n${block.cause}` : valueOf(desk, kind, row, time);
  canvas.style.cursor = cursorOf(kind, handle, block, desk);
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

function cursorOf(kind, handle, block, desk) {
  if (kind === "handle") return CURSORS[handle];
  if (kind === "head") return "text";
  if (kind === "block") return block.editable ? "grab" : "pointer";
  if (kind === "graph") return desk.draws ? "crosshair" : "help";
  return kind === "key" ? "move" : "default";
}

function wheeled(event, desk, x) {
  const unit = event.deltaMode === 1 ? LINE : 1;
  if (event.ctrlKey || event.metaKey) {
    event.preventDefault();
    desk.zoom(Math.exp(-event.deltaY * unit * WHEEL), x);
    return;
  }
  const sideways = event.deltaX || (event.shiftKey ? event.deltaY : 0);
  if (!sideways) return;
  event.preventDefault();
  desk.scene.view.scrollTo(desk.scene.view.start + (sideways * unit) / desk.scene.view.scale);
  desk.repaint();
}
