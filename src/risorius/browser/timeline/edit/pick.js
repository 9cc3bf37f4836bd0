import { edgeNear } from "./edges.js";
import { gripNear } from "./group.js";
import { handlesOf } from "../model/key_shapes.js";
import { keyNear } from "../model/keys.js";
import { markerNear } from "./markers.js";
import { scaleOf } from "../paint/paint_graphs.js";
import { handlePlaces } from "../paint/paint_lanes.js";
import { blockBand, rowAt } from "../model/rows.js";
import { timesOf } from "../model/times.js";
/** @import {Found, GraphRow, LaneRow, SpeechRow} from "../../types.js" */
/** @import {Scene} from "../paint/scene.js" */

/**
 * Return the part of the timeline under a point.
 */

const NEAR_HANDLE = 6;
const NEAR_KEY = 8;
const NEAR_BLOCK = 3; // pixels beside a narrow block that still mean it

/**
 * @param {import("../paint/scene.js").Scene} scene @param {number} x @param {number} y pixels from the top left
 * @returns {Found}
 */
export function pick(scene, x, y) {
  const time = scene.view.time(x);
  if (y < scene.headHeight) return pickHead(scene, rowAt(scene.head, y), [x, y], time);
  const depth = y - scene.headHeight + scene.scroll;
  const row = rowAt(scene.body, depth);
  if (row === null) return { kind: "none", time };
  if (row.kind === "graph") return pickTangent(scene, row, x, depth) ?? pickKey(scene, row, x, depth) ?? { kind: "graph", row, time };
  return pickHandle(scene, row, x, depth) ?? pickBlock(scene, row, x, depth) ?? { kind: "lane", row, time };
}

/**
 * @param {Scene} scene @param {SpeechRow | null} row @param {[x: number, y: number]} place @param {number} time
 * @returns {Found}
 */
function pickHead(scene, row, [x, y], time) {
  const end = gripNear(scene, row, x, y);
  if (end >= 0) return { kind: "grip", row, end, time };
  const index = markerNear(scene, row, x);
  if (index >= 0) return { kind: "marker", row, index, time };
  const phone = edgeNear(scene, row, x);
  return phone < 0 ? { kind: "head", row, time } : { kind: "edge", row, phone, time };
}

/** @param {Scene} scene @param {LaneRow} row @param {number} x @param {number} y @returns {Found | null} */
function pickHandle(scene, row, x, y) {
  const found = scene.model.blocks.get(scene.selected ?? "");
  if (!found?.free || found.channel !== row.lane.channel) return null;
  const block = scene.edits.shown(found);
  if (!block) return null;
  const xs = timesOf(block).map((time) => scene.view.x(time));
  /** @param {{time: number, value: number}} handle */
  const near = handlePlaces(xs, ...blockBand(row, found)).map(([hx, hy], handle) => {
    return { handle, far: Math.max(Math.abs(hx - x), Math.abs(hy - y)) };
  });
  near.sort((a, b) => a.far - b.far);
  if (near[0].far > NEAR_HANDLE) return null;
  return { kind: "handle", row, block: found, handle: near[0].handle, time: scene.view.time(x) };
}

/** @param {Scene} scene @param {LaneRow} row @param {number} x @param {number} y @returns {Found | null} */
function pickBlock(scene, row, x, y) {
  const [from, to] = [scene.view.time(x - NEAR_BLOCK), scene.view.time(x + NEAR_BLOCK)];
  const time = scene.view.time(x);
  let found = null;
  for (const block of row.lane.spans.within(from, to)) {
    const [top, bottom] = blockBand(row, block);
    if (y < top - 1 || y > bottom + 1 || scene.edits.has(block.id)) continue;
    const inside = time >= block.start && time <= block.end;
    if (found === null || inside || block.id === scene.selected) found = block;
    if (block.id === scene.selected && inside) break;
  }
  return found && { kind: "block", row, block: found, time };
}

/**
 * A handle of the selected key.
 * @param {Scene} scene @param {GraphRow} row @param {number} x @param {number} y @returns {Found | null}
 */
function pickTangent({ model, edits, view, selectedKey }, row, x, y) {
  if (!selectedKey || !row.names.includes(selectedKey.parameter)) return null;
  const { parameter, index } = selectedKey;
  const key = edits.keys(parameter)[index];
  const scale = scaleOf(model, row);
  /** @param {{time: number, value: number}} end of a handle */
  const near = ({ time, value }) => Math.hypot(view.x(time) - x, scale.y(value) - y) <= NEAR_KEY;
  const handle = key && handlesOf(key).find(near);
  return handle ? { kind: "tangent", row, parameter, index, side: handle.side, time: view.time(x) } : null;
}

/** @param {Scene} scene @param {GraphRow} row @param {number} x @param {number} y @returns {Found | null} */
function pickKey(scene, row, x, y) {
  const scale = scaleOf(scene.model, row);
  for (const parameter of row.names) {
    const keys = scene.edits.keys(parameter);
    const index = keyNear(keys, ([t, v]) => [scene.view.x(t), scale.y(v)], x, y, NEAR_KEY);
    if (index >= 0) return { kind: "key", row, parameter, index, time: scene.view.time(x) };
  }
  return null;
}
