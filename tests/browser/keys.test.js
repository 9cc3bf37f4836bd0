import assert from "node:assert/strict";
import { test } from "node:test";
import { fieldsOf, handlesOf, keysOf, shapeOf, shaped, traceKeys, withHandle } from "../../src/risorius/browser/timeline/model/key_shapes.js";
import { keyNear, simplified, withKey, withLine, withMoved, without } from "../../src/risorius/browser/timeline/model/keys.js";
import { Trace, near } from "./helpers.js";
/** @import {Key} from "../../src/risorius/browser/types.js" */

const AROUND = { duration: 3, valueAt: (/** @type {number} */ time) => time / 10 };
/** @type {Key[]} */
const KEYS = [[0, 0], [1, 1], [2, 0.5]];

/** @param {Key[]} keys */
const numbersOf = (keys) => keys.flatMap(([time, value]) => [time, value]);

test("a line is simplified within its tolerance", () => {
  const line = Array.from({ length: 400 }, (_, k) => /** @type {Key} */ ([k / 100, Math.sin(k / 40)]));
  const kept = simplified(line, 0.01);
  assert.ok(kept.length < 60);
  for (const [time, value] of line) {
    const k = kept.findIndex(([other]) => other >= time);
    const [[t0, v0], [t1, v1]] = [kept[Math.max(k - 1, 0)], kept[Math.max(k, 1)]];
    assert.ok(Math.abs(value - (v0 + ((v1 - v0) * (time - t0)) / (t1 - t0))) <= 0.01 + 1e-9);
  }
});

test("a first key is tied to the curve around it", () => {
  const keys = withKey([], 1, 0.9, AROUND);
  near(numbersOf(keys), [0.85, 0.085, 1, 0.9, 1.15, 0.115]);
});

test("a line drawn freely takes the place of the keys under it", () => {
  const keys = withLine([[0.2, 0.5], [1, 0.5], [2.9, 0.5]], [[1.5, 1], [0.5, 1]], 0.01, AROUND);
  near(numbersOf(keys), [0.2, 0.5, 0.5, 1, 1.5, 1, 2.9, 0.5]);
});

test("a key stays between its neighbours and can be left out", () => {
  near(numbersOf([withMoved(KEYS, 1, 9, 0.3, 3)[1]]), [1.995, 0.3]);
  assert.deepEqual(without(KEYS, 1), [[0, 0], [2, 0.5]]);
  assert.equal(keyNear(KEYS, ([time, value]) => [100 * time, 100 * value], 103, 97, 4), 1);
});

test("a smooth key is level at a peak, and its handles turn together", () => {
  const smooth = shaped(KEYS, 1, "smooth");
  assert.equal(shapeOf(smooth[1]), "smooth");
  near(handlesOf(smooth[1]).flatMap(({ time, value }) => [time, value]), [2 / 3, 1, 4 / 3, 1]);
  const bent = withHandle(smooth, 1, "after", [0.5, 0.25], false);
  near(bent[1][2]?.before ?? [], [-1 / 3, -1 / 6]);
  assert.equal(shapeOf(shaped(smooth, 1, "straight")[1]), "straight");
  assert.equal(shapeOf(shaped(smooth, 1, "hold")[1]), "hold");
});

test("keys and their shapes become fields of the wire and come back", () => {
  assert.deepEqual(fieldsOf(KEYS), { keys: KEYS });
  const held = shaped(KEYS, 0, "hold");
  const { keys, shapes } = fieldsOf(held);
  assert.deepEqual(keysOf(/** @type {any} */ ({ keys, shapes })), held);
});

test("a curve is traced straight, held or bent", () => {
  const trace = new Trace();
  const keys = shaped(shaped(KEYS, 0, "hold"), 2, "smooth");
  traceKeys(/** @type {any} */ (trace), keys, (time) => time, (value) => value);
  assert.deepEqual(trace.calls.map(([kind]) => kind), ["move", "line", "line", "bezier"]);
  assert.deepEqual(trace.calls[1], ["line", 1, 0]);
});
