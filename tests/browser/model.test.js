import assert from "node:assert/strict";
import { test } from "node:test";
import { pasted } from "../../src/risorius/browser/timeline/edit/clipboard.js";
import { editsOf, movedTogether, spanOf } from "../../src/risorius/browser/timeline/edit/group.js";
import { Model } from "../../src/risorius/browser/timeline/model/model.js";
import { near } from "./helpers.js";

/** @type {any} */
const CATALOGUE = {
  channels: ["lips", "head"].map((name, priority) => ({ name, priority })),
  parameters: ["frontalis.left", "frontalis.right", "head_yaw"].map((name) => ({
    name, base: name.split(".")[0], low: 0, high: 1, neutral: name === "head_yaw" ? 0.25 : 0, kind: name === "head_yaw" ? "turn" : "muscle",
  })),
}; // prettier-ignore
/** @param {string} id @param {string} channel @param {number} start */
const block = (id, channel, start) => ({ id, channel, start, apex_start: start + 0.2, apex_end: start + 0.5, end: start + 1, editable: true, layer: "" });
/** @type {any} */
const TAKE = {
  take: 1, duration: 3, rate: 2, frames: 7, markers: [{ time: 0.7, text: "" }], lanes: { muted: [], solo: [], locked: ["head"] },
  blocks: [block("a", "lips", 0), block("b", "head", 1), block("c", "lips", 0.5)],
  curves: { "frontalis.left": Float32Array.from([0, 1, 0, 0, 0, 0, 0]), "frontalis.right": Float32Array.from([0, 0.5, 0, 0, 0, 0, 0]) },
  drawn: [], speech: { words: [], phones: [{ start: 1, end: 1.5 }], pauses: [], tones: [], waves: [{ peaks: Int8Array.from([-90, 20]) }] },
}; // prettier-ignore

test("a take is lanes of blocks, curves and edges", () => {
  const model = new Model(TAKE, CATALOGUE);
  assert.deepEqual(model.lanes.map(({ channel, count }) => [channel, count]), [["lips", 2], ["head", 1]]);
  assert.deepEqual([model.blocks.get("a")?.free, model.blocks.get("b")?.free], [true, false]);
  near(model.edges, [0, 0.7, 1, 1.5, 3]);
  assert.deepEqual(model.liveliest, ["frontalis"]);
  assert.deepEqual(model.named("frontalis"), ["frontalis.left", "frontalis.right"]);
  near([model.valueAt("frontalis.left", 0.25), model.valueAt("head_yaw", 1)], [0.5, 0.25]);
  assert.equal(model.differ("frontalis.left", "frontalis.right"), true);
  assert.equal(model.speech?.loudest, 90);
});

test("what is the same as in the take before is taken over", () => {
  const before = new Model(TAKE, CATALOGUE);
  const after = new Model({ ...TAKE, take: 2 }, CATALOGUE, before);
  assert.equal(after.speech, before.speech);
  assert.equal(after.curve("frontalis.left"), before.curve("frontalis.left"));
  after.previewed = new Map([["frontalis.left", null]]);
  assert.equal(after.curve("frontalis.left"), null);
});

test("solo and muted lanes say what is silent", () => {
  /** @param {object} lanes */
  const silent = (lanes) => [...new Model({ ...TAKE, lanes: { ...TAKE.lanes, ...lanes } }, CATALOGUE).silent];
  assert.deepEqual(silent({ muted: ["lips"] }), ["lips"]);
  assert.deepEqual(silent({ solo: ["lips"] }), ["head"]);
});

test("blocks move together as far as all stay in the take", () => {
  const all = [[0.5, 1, 1, 1.5], [2, 2.2, 2.4, 2.5]];
  near(movedTogether(all, 9, 3)[0], [1, 1.5, 1.5, 2]);
  near(movedTogether(all, -9, 3)[1], [1.5, 1.7, 1.9, 2]);
  const blocks = /** @type {any} */ (TAKE.blocks.slice(0, 2));
  const edits = editsOf(blocks, [[0, 0.2, 0.5, 1], [1.5, 1.7, 2, 2.5]]);
  assert.deepEqual(edits.map(({ kind, movement }) => [kind, movement]), [["move", "b"]]);
});

test("a selection reaches from its first start to its last end", () => {
  const model = new Model(TAKE, CATALOGUE);
  const edits = { shown: () => null };
  assert.deepEqual(spanOf(/** @type {any} */ ({ model, edits, group: new Set(["a", "b"]) })), [0, 2]);
  assert.equal(spanOf(/** @type {any} */ ({ model, edits, group: new Set(["a"]) })), null);
});

test("what is pasted starts at a time, or earlier where it would not fit", () => {
  const movements = /** @type {any} */ ([{ start: 0, end: 1, channel: "head" }, { start: 0.5, end: 2, channel: "head" }]);
  assert.deepEqual(pasted(movements, 0.5, 3).map(({ kind, start, end }) => [kind, start, end]), [["add", 0.5, 1.5], ["add", 1, 2.5]]);
  assert.equal(pasted(movements, 9, 3)[0].start, 1);
});
