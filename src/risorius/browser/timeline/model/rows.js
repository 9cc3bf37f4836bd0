/**
 * The layout from top to bottom, in pixels: the head (ruler, sound, words, phones), which stays in view,
 * then lanes and graphs, which scroll.
 */

/** @import {Band, Block, BodyRow, LaneRow, SpeechRow} from "../../types.js" */

const RULER = 20;
/** @type {[SpeechRow["kind"], number][]} */
const SPEECH = [
  ["wave", 34],
  ["words", 16],
  ["phones", 15],
];
export const BLOCK = 17; // height of one row of blocks
const LANE_PAD = 2;
const LEAST = 25; // minimum height of a lane: its name is a button for fingers
export const GRAPH = 52;

/** @param {import("./model.js").Model} model @returns {SpeechRow[]} */
export function headRows(model) {
  /** @type {SpeechRow[]} */
  const rows = [{ kind: "ruler", y: 0, height: RULER }];
  let y = RULER;
  for (const [kind, height] of model.speech ? SPEECH : []) {
    rows.push({ kind, y, height });
    y += height;
  }
  return rows;
}

/**
 * @param {import("./model.js").Model} model
 * @param {{base: string, names: string[]}[]} graphs those beneath the lanes
 * @param {Set<string>} folded channels whose lanes show all movements on one row
 * @returns {BodyRow[]}
 */
export function bodyRows(model, graphs, folded) {
  /** @type {BodyRow[]} */
  const rows = [];
  let y = 0;
  for (const lane of model.lanes) {
    const fold = folded.has(lane.channel);
    const height = Math.max((fold ? 1 : lane.count) * BLOCK + 2 * LANE_PAD, LEAST);
    rows.push({ kind: "lane", y, height, lane, fold });
    y += height;
  }
  for (const graph of graphs) {
    rows.push({ kind: "graph", y, height: GRAPH, ...graph });
    y += GRAPH;
  }
  return rows;
}

/** @param {{y: number, height: number}[]} rows */
export function heightOf(rows) {
  const last = rows.at(-1);
  return last ? last.y + last.height : 0;
}

/** Top and bottom of a block, from the top of the body. @param {LaneRow} row @param {Block} block @returns {Band} */
export function blockBand(row, block) {
  const place = row.fold ? 0 : (row.lane.rows.get(block) ?? 0);
  const top = row.y + LANE_PAD + place * BLOCK;
  return [top + 1, top + BLOCK - 1];
}

/** The row at a height, or null. @template {{y: number, height: number}} R @param {R[]} rows @param {number} y */
export function rowAt(rows, y) {
  return rows.find((row) => y >= row.y && y < row.y + row.height) ?? null;
}
