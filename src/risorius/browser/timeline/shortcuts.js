/**
 * Keys of the timeline that need no focused block; they are handled only if the timeline itself does not use them.
 */

import { foundIn } from "./dom.js";
import { nudgeEdge } from "./edit/edges.js";

const ZOOM = 1.4;

/** The timeline's entries in the page's list of keys. */
export const TIMELINE_KEYS = [
  { keys: "Ctrl wheel, + −", does: "Timeline: zoom" },
  { keys: "N", does: "Timeline: add a movement at the playhead" },
  { keys: "[ ]", does: "Timeline: move the word or phone boundary at the playhead earlier or later" },
  { keys: "M", does: "Timeline: set a marker at the playhead" },
  { keys: "< >", does: "Timeline: go to the previous or next marker" },
  { keys: "D", does: "Timeline: turn drawing on graphs on or off" },
  { keys: "↑ ↓", does: "Movements: previous, next" },
  { keys: "Page ↑ ↓", does: "Movements: previous lane, next lane" },
  { keys: "← →", does: "Movements: move by a frame" },
  { keys: "Shift ← →", does: "Movements: stretch the end" },
  { keys: "Alt ← →", does: "Movements: stretch the start" },
  { keys: "Ctrl ← →", does: "Movements: lengthen or shorten the onset" },
  { keys: "Ctrl Shift ← →", does: "Movements: lengthen or shorten the offset" },
  { keys: "Shift click, drag a box", does: "Movements: select several, to move, stretch, copy and delete them together" },
  { keys: "Ctrl A", does: "Movements: select all of the lane" },
  { keys: "Ctrl C, Ctrl X, Ctrl V", does: "Movements: copy, cut, paste at the playhead" },
  { keys: "Delete", does: "Movements: delete" },
  { keys: "Escape", does: "Movements: select none; cancel a drag" },
];

/** @param {HTMLElement} root @param {import("./controller.js").TimelineController} controller @param {() => void} add */
export function shortcuts(root, controller, add) {
  /** @type {Record<string, () => unknown>} */
  const keys = {
    "+": () => controller.zoom(ZOOM),
    "=": () => controller.zoom(ZOOM),
    "-": () => controller.zoom(1 / ZOOM),
    "[": () => nudgeEdge(controller, controller.clock.time, -1),
    "]": () => nudgeEdge(controller, controller.clock.time, 1),
    n: () => add(),
    m: () => controller.addMarker(),
    "<": () => controller.goMarker(-1),
    ">": () => controller.goMarker(1),
    d: () => foundIn(root, "#tl-draw")?.click(),
    ArrowLeft: () => controller.clock.step(-1),
    ArrowRight: () => controller.clock.step(1),
    Escape: () => controller.choose(null),
    Delete: () => controller.remove(),
    Backspace: () => controller.remove(),
  };
  /** @type {Record<string, () => unknown>} */
  const withControl = {
    a: () => controller.chooseLane(),
    c: () => controller.copy(),
    x: () => controller.cut(),
    v: () => controller.paste(),
  };
  root.addEventListener("keydown", (event) => {
    if (event.altKey || typing(event.target)) return;
    const held = event.ctrlKey || event.metaKey;
    if (event.shiftKey && (held || !"<>+".includes(event.key))) return;
    const act = (held ? withControl : keys)[event.key];
    if (!act || !controller.scene.model) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  });
}

/** @param {EventTarget | null} element */
function typing(element) {
  if (element instanceof HTMLInputElement) return element.type !== "checkbox";
  return element instanceof HTMLTextAreaElement || element instanceof HTMLSelectElement;
}
