import { Adder } from "./edit/adder.js";
import { BlockList } from "./lists/blocklist.js";
import { h } from "./dom.js";
import { MarkerList } from "./edit/markers.js";
import { Names } from "./lists/names.js";
import { Overview } from "./paint/overview.js";
import { Picker } from "./lists/picker.js";
import { listen } from "./edit/pointer.js";
import { shortcuts } from "./shortcuts.js";
import { Tools } from "./lists/tools.js";
import { Why } from "./lists/why.js";

/** The elements of the timeline, not yet assembled. */
export function frameOf() {
  const canvas = h("canvas", { id: "tl-canvas", tabindex: "-1", role: "img" });
  const playhead = h("div", { class: "tl-playhead" });
  return {
    root: h("div", { class: "tl" }),
    scroller: h("div", { class: "tl-scroller" }),
    canvas,
    playhead,
    frame: h("div", { class: "tl-window" }, canvas, playhead),
    depth: h("div", { class: "tl-depth" }),
    status: h("div", { class: "tl-status" }),
  };
}

/**
 * Assemble the elements, with the tools and lists around the canvas.
 *
 * @param {ReturnType<typeof frameOf>} frame
 * @param {import("./controller.js").TimelineController} controller
 * @param {import("./model/graphs.js").Graphs} graphs
 * @param {HTMLElement} explanation
 */
export function fitted({ root, scroller, canvas, frame, depth, status }, controller, graphs, explanation) {
  const adder = new Adder(root, controller);
  const picker = new Picker(root, controller, graphs);
  const list = new BlockList(root, controller);
  /** @param {number} [time] @param {string | null} [channel] */
  const add = (time = controller.clock.time, channel = null) => controller.scene.model && adder.open(time, channel);
  const walk = () => list.focus();
  const markers = new MarkerList(root, controller);
  /** @param {number} [index] */
  const note = (index) => markers.open(index);
  const tools = new Tools(root, controller, { add: () => add(), blocks: walk, markers: () => note(), graphs: picker.button() });
  const names = new Names(scroller, controller, graphs);
  scroller.append(frame, depth);
  root.append(scroller, status);
  const overview = new Overview(root, controller);
  root.append(h("p", { class: "tl-empty" }, "The timeline of your performance appears here."));
  const why = new Why(explanation, controller);
  listen(canvas, controller, { add, walk, note });
  shortcuts(root, controller, add);
  return { list, tools, names, overview, why };
}
