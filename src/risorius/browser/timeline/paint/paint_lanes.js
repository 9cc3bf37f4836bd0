import { spoken } from "../dom.js";
import { blockBand } from "../model/rows.js";
/** @import {Band, Block, LaneRow} from "../../types.js" */
/** @import {Model} from "../model/model.js" */
/** @import {Scene} from "./scene.js" */

/**
 * The lanes: each movement as an outline that shows its onset, apex and offset.
 */

const SMALLEST = 2; // pixels: a narrower block is a stroke, and only one of those is drawn in a pixel
const LABELLED = 34;
const HANDLE = 3.5; // half the size of a handle
const LEAST_HEIGHT = 0.45; // share of its row that the weakest movement fills

/**
 * The end of the last stroke and label in each row of blocks, by its top, so that nothing is drawn
 * over another.
 * @typedef {{silent: boolean, strokes: Map<number, number> | null, labels: Map<number, number>}} Drawn
 */

/** @param {Scene} scene @param {LaneRow} row */
export function paintLane(scene, row) {
  const { context, view, palette, edits, selected, group } = scene;
  context.fillStyle = palette.grid;
  context.fillRect(0, row.y + row.height - 1, scene.width, 1);
  const silent = scene.model.silent.has(row.lane.channel);
  const drawn = { silent, strokes: new Map(), labels: new Map() };
  for (const block of row.lane.spans.within(view.start, view.end)) {
    if (block.id === selected || group.has(block.id) || edits.has(block.id)) continue;
    paintBlock(scene, row, block, drawn);
  }
  for (const id of new Set([...edits.held, ...group, selected])) {
    const block = scene.model.blocks.get(id ?? "");
    if (block?.channel === row.lane.channel) paintBlock(scene, row, block, { silent, strokes: null, labels: new Map() });
  }
}

/** @param {Scene} scene @param {LaneRow} row @param {Block} block @param {Drawn} drawn */
function paintBlock(scene, row, block, { silent, strokes, labels }) {
  const { context, view, palette, count, selected, hovered, focused } = scene;
  const shown = scene.edits.shown(block);
  if (shown === null) return;
  const xs = [shown.start, shown.apex_start, shown.apex_end, shown.end].map((time) => view.x(time));
  const [top, bottom] = blockBand(row, block);
  const colour = palette.channels[block.channel];
  if (strokes && xs[3] - xs[0] < SMALLEST) {
    if (strokes.get(top) === Math.floor(xs[0])) return;
    strokes.set(top, Math.floor(xs[0]));
    context.fillStyle = colour;
    context.fillRect(xs[0], top + 3, 1, bottom - top - 3);
    count.blocks++;
    return;
  }
  count.blocks++;
  const chosen = block.id === selected || scene.group.has(block.id);
  if (silent) outlineBlock(scene, xs, [top, bottom], colour);
  else fillBlock(scene, shown, xs, [top, bottom], colour, chosen || block.id === hovered);
  if (shown.edited) paintEdited(context, xs, top, colour);
  paintLabel(scene, shown, xs, [top, bottom], labels);
  if (chosen) paintChosen(scene, shown, xs, [top, bottom], focused);
}

/**
 * Draw a movement of a muted lane.
 * @param {Scene} scene @param {number[]} xs @param {Band} band @param {string} colour
 */
function outlineBlock({ context }, xs, [top, bottom], colour) {
  context.strokeStyle = colour;
  context.globalAlpha = 0.6;
  context.lineWidth = 1;
  context.strokeRect(xs[0] + 0.5, top + 0.5, Math.max(xs[3] - xs[0] - 1, 1), bottom - top - 1);
  context.globalAlpha = 1;
}

/**
 * @param {Scene} scene @param {Block} block @param {number[]} xs @param {Band} band @param {string} colour
 * @param {boolean} strong
 */
function fillBlock({ context, shapes, model, view }, block, xs, [top, bottom], colour, strong) {
  const seen = xs.map((x) => Math.max(-4000, Math.min(x, view.width + 4000)));
  context.fillStyle = colour;
  context.globalAlpha = strong ? 0.3 : 0.16;
  context.fillRect(xs[0], top, Math.max(xs[3] - xs[0], 1), bottom - top);
  context.globalAlpha = strong ? 0.95 : 0.72;
  context.beginPath();
  const height = (bottom - top) * (LEAST_HEIGHT + (1 - LEAST_HEIGHT) * strength(block, model));
  if (block.editable) shapes.trace(context, block, seen, bottom - height, bottom);
  else context.rect(seen[0] + 0.5, bottom - height, Math.max(seen[3] - seen[0] - 1, 1), height);
  context.fill();
  context.globalAlpha = 1;
}

/**
 * Return the strength of a movement: its greatest target as a share of its parameter's range, 0 to 1.
 * @param {Block} block @param {Model} model
 */
function strength(block, model) {
  if (!block.editable) return block.label ? 0.6 : 0;
  let most = 0;
  for (const [name, value] of Object.entries(block.targets)) {
    const parameter = model.parameters.get(name);
    if (parameter?.signed) most = Math.max(most, Math.sqrt(Math.abs(value) / parameter.high));
    else if (parameter) most = Math.max(most, (value - parameter.neutral) / (parameter.high - parameter.neutral));
  }
  return Math.min(Math.abs(most), 1);
}

/** @param {CanvasRenderingContext2D} context @param {number[]} xs @param {number} top @param {string} colour */
function paintEdited(context, xs, top, colour) {
  context.fillStyle = colour;
  context.beginPath();
  context.moveTo(xs[3], top);
  context.lineTo(xs[3] - 6, top);
  context.lineTo(xs[3], top + 6);
  context.fill();
}

/** @param {Scene} scene @param {Block} block @param {number[]} xs @param {Band} band @param {Map<number, number>} labels */
function paintLabel({ context, view, palette, count }, block, xs, [top, bottom], labels) {
  const [left, right] = [Math.max(xs[0], 0) + 4, Math.min(xs[3], view.width) - 3];
  const phone = !block.editable;
  if (!block.label || (!phone && right - left < LABELLED)) return;
  if (left < (labels.get(top) ?? -Infinity)) return;
  context.font = `${phone ? 10 : 11}px ${palette.font}`;
  if (phone && context.measureText(block.label).width > right - left + 4) return;
  const text = phone ? block.label : labelWithin(context, block, right - left);
  labels.set(top, left + Math.min(context.measureText(text).width, right - left));
  context.fillStyle = palette.label;
  context.textBaseline = "middle";
  context.textAlign = phone ? "center" : "left";
  context.save();
  context.beginPath();
  context.rect(left - 2, top, right - left + 3, bottom - top);
  context.clip();
  context.fillText(text, phone ? (left + right) / 2 : left, (top + bottom) / 2 + 1);
  context.restore();
  count.texts++;
}

/**
 * Return a label that fits: movement and word, else the movement alone (the word is shown above), shortened if needed.
 * @param {CanvasRenderingContext2D} context @param {Block} block @param {number} room
 */
export function labelWithin(context, block, room) {
  const layer = layerOf(block);
  const texts = layer ? [`${layer} ${block.label}`, layer] : [block.label];
  const fits = texts.find((text) => context.measureText(text).width <= room);
  if (fits !== undefined) return fits;
  const letters = [...texts[texts.length - 1]];
  while (letters.length > 1 && context.measureText(`${letters.join("")}…`).width > room) letters.pop();
  return `${letters.join("").trimEnd()}…`;
}

/**
 * Return the readable name of a layer ("brows"), or "" for one that only counts ("1.happiness").
 * @param {Block} block
 */
function layerOf({ layer, label }) {
  const name = spoken(layer.replace(/^\d+\./, ""));
  return label.includes(name) ? "" : name;
}

/** @param {Scene} scene @param {Block} block @param {number[]} xs @param {Band} band @param {boolean} focused */
function paintChosen({ context, palette }, block, xs, [top, bottom], focused) {
  context.strokeStyle = palette.mark;
  context.lineWidth = focused ? 2.5 : 1.5;
  context.strokeRect(xs[0] - 1, top - 1, xs[3] - xs[0] + 2, bottom - top + 2);
  if (!block.free) return;
  for (const [x, y] of handlePlaces(xs, top, bottom)) {
    context.fillStyle = palette.ground;
    context.fillRect(x - HANDLE, y - HANDLE, 2 * HANDLE, 2 * HANDLE);
    context.lineWidth = 1.5;
    context.strokeRect(x - HANDLE, y - HANDLE, 2 * HANDLE, 2 * HANDLE);
  }
}

/**
 * Return the places of the handles: start, end of onset, start of offset, end.
 * @param {number[]} xs @param {number} top @param {number} bottom @returns {[x: number, y: number][]}
 */
export function handlePlaces(xs, top, bottom) {
  return [[xs[0], bottom], [xs[1], top], [xs[2], top], [xs[3], bottom]];
}
