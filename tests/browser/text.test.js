import assert from "node:assert/strict";
import { test } from "node:test";
import { emptyFace, groupsOf } from "../../src/risorius/browser/panels/dialled.js";
import { hueOf } from "../../src/risorius/browser/panels/hues.js";
import { characterAt, movedSpans, unitAt } from "../../src/risorius/browser/parts/text.js";

test("characters are counted, not UTF-16 units", () => {
  const text = "a😀b";
  assert.deepEqual([characterAt(text, 3), unitAt(text, 2)], [2, 3]);
  for (let k = 0; k <= 3; k++) assert.equal(characterAt(text, unitAt(text, k)), k);
});

test("spans keep to their words while the text around them changes", () => {
  const spans = [{ first: 4, last: 7 }, { first: null, last: null }];
  /** @param {string} after */
  const moved = (after) => movedSpans(spans, "one two three", after).map(({ first, last }) => [first, last]);
  assert.deepEqual(moved("One, and two three"), [[9, 12], [null, null]]);
  assert.deepEqual(moved("one twwo three"), [[4, 8], [null, null]]);
  assert.deepEqual(moved("one two three four"), [[4, 7], [null, null]]);
  assert.deepEqual(moved("one  three"), [[null, null]]);
});

/** @type {any} */
const CATALOGUE = {
  emotions: [{ name: "joy", description: "" }, { name: "fear", description: "" }],
  action_units: [{ name: "AU1", title: "Raise", targets: { "frontalis.left": 1 }, approximate: false }],
  parameters: ["left", "right"].map((side) => (
    { name: `frontalis.${side}`, base: "frontalis", side, group: "brows", low: 0, high: 1, neutral: 0, number: 9, unit: "" })),
};

test("a dial turns both sides or one, and leaves out what is at rest", () => {
  const [both] = groupsOf(CATALOGUE, "muscles", "both")[0].dials;
  const raised = both.set(emptyFace(), 0.5);
  assert.deepEqual(raised.values, { "frontalis.left": 0.5, "frontalis.right": 0.5 });
  const [right] = groupsOf(CATALOGUE, "muscles", "right")[0].dials;
  assert.equal(right.get(raised), 0.5);
  assert.deepEqual(right.set(raised, 0).values, { "frontalis.left": 0.5 });
  const [unit] = groupsOf(CATALOGUE, "units", "left")[0].dials;
  assert.deepEqual(unit.set(emptyFace(), 1).values, { "AU1.left": 1 });
  const [joy] = groupsOf(CATALOGUE, "emotions", "both")[0].dials;
  assert.deepEqual(joy.set(emptyFace(), 1).emotions, { joy: 1 });
});

test("each emotion has a hue of its own", () => {
  assert.notEqual(hueOf(CATALOGUE, "joy"), hueOf(CATALOGUE, "fear"));
  assert.ok(Number.isFinite(hueOf(null, "joy")));
});
