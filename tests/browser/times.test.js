import assert from "node:assert/strict";
import { test } from "node:test";
import { editOf, moved, nearest, pulled, snappedBy, stretchTo, stretchedTogether, timesOf } from "../../src/risorius/browser/timeline/model/times.js";
import { near } from "./helpers.js";

const TIMES = [1, 1.2, 1.5, 2];
const EDGES = new Float64Array([0, 0.5, 1.0, 1.5, 2.0]);

test("a block is moved within the take", () => {
  near(moved(TIMES, 0.5, 3), [1.5, 1.7, 2.0, 2.5]);
  near(moved(TIMES, -9, 3), [0, 0.2, 0.5, 1.0]);
  near(moved(TIMES, 9, 3), [2.0, 2.2, 2.5, 3.0]);
});

test("a block's times are pulled one by one", () => {
  near(pulled(TIMES, 0, 0.5, 3), [0.5, 0.7, 1.5, 2]);
  near(pulled(TIMES, 3, 2.5, 3), [1, 1.2, 2.0, 2.5]);
  near(pulled(TIMES, 1, 1.8, 3), [1, 1.5, 1.5, 2]);
  near(pulled(TIMES, 2, 1.0, 3), [1, 1.2, 1.2, 2]);
});

test("onset and offset shrink in proportion where both do not fit", () => near(pulled(TIMES, 3, 1.35, 3), [1, 1.1, 1.1, 1.35]));

test("a moved block snaps to an edge in reach", () => {
  near([snappedBy(EDGES, [0.9, 1, 1.1, 1.48], 0.05)], [0.02]);
  assert.equal(snappedBy(EDGES, [0.7, 1, 1.1, 1.3], 0.05), 0);
  assert.equal(nearest(EDGES, 1.04, 0.05), 1);
  assert.equal(nearest(EDGES, 1.2, 0.05), null);
});

test("the edit of the wire says what became other", () => {
  const move = editOf(TIMES, [1.5, 1.7, 2, 2.5]);
  assert.equal(move?.kind, "move");
  near([move?.fields.start ?? NaN], [1.5]);
  assert.deepEqual(editOf(TIMES, [1, 1.2, 2, 2.5]), { kind: "stretch", fields: { end: 2.5 } });
  const onset = editOf(TIMES, [1, 1.4, 1.5, 2]);
  near([onset?.fields.onset ?? NaN], [0.4]);
  assert.equal(editOf(TIMES, [1, 1.2, 1.5, 2]), null);
});

test("all times of a block are told", () => {
  const { kind, fields } = stretchTo([1, 1.25, 1.5, 2]);
  assert.deepEqual({ kind, fields }, { kind: "stretch", fields: { start: 1, end: 2, onset: 0.25, offset: 0.5 } });
  assert.deepEqual(timesOf(/** @type {any} */ ({ start: 1, apex_start: 2, apex_end: 3, end: 4 })), [1, 2, 3, 4]);
});

test("blocks stretched together keep what lies at the fixed end", () => {
  const [first, second] = stretchedTogether([[0, 1, 2, 3], [3, 4, 5, 6]], 0, 6, 3, 10);
  near(first, [0, 0.5, 1, 1.5]);
  near(second, [1.5, 2, 2.5, 3]);
});
