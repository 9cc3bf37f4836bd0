import assert from "node:assert/strict";
import { test } from "node:test";
import { changedTake, curvesOf, rateOf, takeOf } from "../../src/risorius/browser/player/take.js";

/** @param {number[]} numbers */
const encoded = (numbers) => Buffer.from(new Float32Array(numbers).buffer).toString("base64");
const VIEW = /** @type {any} */ ({
  take: 1, fps: "24000/1001", frames: 2, curves: { masseter: encoded([0, 0.5]), risorius: encoded([1, 1]) }, speech: null, made: {},
  blocks: [{ id: "a", start: 0 }, { id: "b", start: 1 }],
}); // prettier-ignore

test("frame rates are numbers", () => {
  assert.equal(rateOf("30"), 30);
  assert.ok(Math.abs(rateOf("24000/1001") - 23.976) < 1e-3);
});

test("a take's curves and peaks are decoded", () => {
  const waves = [{ seconds_per_bucket: 0.1, peaks: Buffer.from([255, 1]).toString("base64") }];
  const take = takeOf({ ...VIEW, speech: { waves } });
  assert.deepEqual([...take.curves.masseter], [0, 0.5]);
  assert.deepEqual([...(take.speech?.waves[0].peaks ?? [])], [-1, 1]);
});

test("a change replaces, adds and drops", () => {
  const take = takeOf(VIEW);
  const change = { take: 2, gone: ["a"], blocks: [{ id: "b", start: 3 }, { id: "c", start: 2 }], curves: { masseter: "", mentalis: encoded([1]) }, made: {} };
  const after = changedTake(take, /** @type {any} */ (change));
  assert.deepEqual(after.blocks.map(({ id }) => id), ["c", "b"]);
  assert.deepEqual(Object.keys(after.curves).sort(), ["mentalis", "risorius"]);
  assert.deepEqual([after.take, after.rate], [2, take.rate]);
  assert.equal(changedTake(take, /** @type {any} */ ({ whole: { ...VIEW, take: 9 } })).take, 9);
});

test("curves of an answer come to rest where they are empty", () => {
  const curves = curvesOf({ masseter: encoded([1]), mentalis: "" });
  assert.deepEqual([...(curves.get("masseter") ?? [])], [1]);
  assert.equal(curves.get("mentalis"), null);
});
