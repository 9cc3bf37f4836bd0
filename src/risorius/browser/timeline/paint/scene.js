import { contextOf } from "../../parts/dom.js";
import { graphics } from "../../stage/graphics.js";
import { paintSpan } from "../edit/group.js";
import { paintMarkers } from "../edit/markers.js";
import { clockTime, paintRuler, paintTexts, paintWave } from "./paint_head.js";
import { paintGraph } from "./paint_graphs.js";
import { paintLane } from "./paint_lanes.js";
import { bodyRows, headRows, heightOf } from "../model/rows.js";
/** @import {BodyRow, Box, Palette, SpeechRow} from "../../types.js" */

const TEXT = 16; // text size of the page at which one pixel of the scene is one of the page

/**
 * The state that a picture of the timeline is drawn from, and the drawing itself.
 *
 * Only visible parts are drawn: `count` is the number of parts drawn last.
 */
export class Scene {
  /** @type {import("../model/model.js").Model} there set with the first take: nothing is drawn before */
  model = /** @type {any} */ (null);
  /** @type {SpeechRow[]} */
  head = [];
  /** @type {BodyRow[]} */
  body = [];
  /** @type {{base: string, names: string[]}[]} */
  graphs = [];
  /** @type {Set<string>} channels */
  folded = new Set();
  unit = 1; // pixels of the page in one of the scene: the timeline scales with the page's text
  scroll = 0;
  height = 0;
  time = 0;
  /** @type {string | null} a block's id */
  selected = null;
  /** @type {Set<string>} ids of all selected blocks, where they are several */
  group = new Set();
  /** @type {Box | null} from the top of the body, while blocks are selected by it */
  box = null;
  /** @type {string | null} */
  hovered = null;
  /** @type {{parameter: string, index: number} | null} */
  selectedKey = null;
  focused = false; // whether the selected block has the keyboard
  /** @type {[number, number] | null} the loop range */
  loop = null;
  /** @type {number | null} time of the edge that a drag has snapped to */
  guide = null;
  /** @type {{time: number, name: string} | null} the explained parameter and time */
  marked = null;
  /** @type {import("../model/shape.js").Shapes} */
  shapes = /** @type {any} */ (null);
  /** @type {Palette} */
  palette = /** @type {any} */ (null);
  count = nothing();

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {{view: import("../model/viewport.js").Viewport, edits: import("../edit/edits.js").Edits, details: import("../model/details.js").Details}} parts
   */
  constructor(canvas, { view, edits, details }) {
    // An accelerated canvas without a real graphics card is ten times slower than a plain one.
    this.context = contextOf(canvas, { willReadFrequently: graphics() !== "card" });
    this.canvas = canvas;
    this.view = view;
    this.edits = edits;
    this.details = details;
  }

  get width() {
    return this.view.width;
  }

  get headHeight() {
    return heightOf(this.head);
  }

  get bodyHeight() {
    return heightOf(this.body);
  }

  /** Update the layout for another model or other graphs. */
  arrange() {
    this.head = headRows(this.model);
    this.body = bodyRows(this.model, this.graphs, this.folded);
  }

  /** Set the canvas's size in the page's pixels. @param {number} width @param {number} height */
  resize(width, height) {
    this.unit = parseFloat(getComputedStyle(document.documentElement).fontSize) / TEXT;
    const ratio = devicePixelRatio || 1;
    this.height = height / this.unit;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.context.setTransform(ratio * this.unit, 0, 0, ratio * this.unit, 0, 0);
    this.view.resize(width / this.unit, this.model?.duration ?? 1);
  }

  paint() {
    this.count = nothing();
    const { context, palette, width, height, headHeight } = this;
    context.fillStyle = palette.ground;
    context.fillRect(0, 0, width, height);
    if (!this.model) return;
    context.save();
    context.beginPath();
    context.rect(0, headHeight, width, Math.max(height - headHeight, 0));
    context.clip();
    context.translate(0, headHeight - this.scroll);
    this.#paintWords();
    for (const row of this.visible()) {
      if (row.kind === "lane") paintLane(this, row);
      else paintGraph(this, row);
    }
    this.#paintMarked();
    this.#paintBox();
    context.restore();
    this.#paintHead();
    if (this.guide !== null) this.#line(this.guide, palette.mark, [2, 2]);
  }

  /** Return the visible rows of the body. */
  visible() {
    const [top, bottom] = [this.scroll, this.scroll + this.height - this.headHeight];
    return this.body.filter((row) => row.y < bottom && row.y + row.height > top);
  }

  #paintHead() {
    const { context, palette, width, headHeight } = this;
    context.fillStyle = palette.head;
    context.fillRect(0, 0, width, headHeight);
    for (const row of this.head) {
      if (row.kind === "ruler") this.#paintRuler(row);
      else if (row.kind === "wave") paintWave(this, row);
      else paintTexts(this, row);
    }
    context.fillStyle = palette.rule;
    context.fillRect(0, headHeight - 1, width, 1);
  }

  /** @param {SpeechRow} row */
  #paintRuler(row) {
    paintRuler(this, row);
    paintMarkers(this, row);
    paintSpan(this, row);
  }

  /** Draw faint lines at the starts of words, if they are far enough apart. */
  #paintWords() {
    const { context, view, palette, model, count } = this;
    context.fillStyle = palette.grid;
    let last = -Infinity;
    for (const word of model.speech?.words.within(view.start, view.end) ?? []) {
      const x = Math.round(view.x(word.start));
      if (x - last < 12) continue;
      context.fillRect(x, 0, 1, this.bodyHeight);
      last = x;
      count.marks++;
    }
  }

  /** Draw a marker at the explained time. */
  #paintMarked() {
    const { marked } = this;
    const row = marked && this.body.find((r) => r.kind === "graph" && r.names.includes(marked.name));
    if (!marked || !row) return;
    this.context.fillStyle = this.palette.mark;
    this.context.fillRect(this.view.x(marked.time) - 0.5, row.y, 1, row.height - 1);
  }

  #paintBox() {
    if (this.box === null) return;
    const { x0, y0, x1, y1 } = this.box;
    this.context.strokeStyle = this.palette.mark;
    this.context.setLineDash([3, 2]);
    this.context.strokeRect(x0, y0, x1 - x0, y1 - y0);
    this.context.setLineDash([]);
  }

  /** @param {number} time @param {string} colour @param {number[]} dash */
  #line(time, colour, dash) {
    const { context, view, height } = this;
    context.strokeStyle = colour;
    context.lineWidth = 1;
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(Math.round(view.x(time)) + 0.5, 0);
    context.lineTo(Math.round(view.x(time)) + 0.5, height);
    context.stroke();
    context.setLineDash([]);
  }
}

function nothing() {
  return { blocks: 0, points: 0, columns: 0, texts: 0, marks: 0 };
}

export { clockTime };
