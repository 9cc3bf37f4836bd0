import assert from "node:assert/strict";
import { test } from "node:test";
import { Spans, stacked } from "../../src/risorius/browser/timeline/model/spans.js";
import { randoms } from "./helpers.js";

test("stacked spans do not hide each other", () => {
  const random = randoms(7);
  const items = Array.from({ length: 400 }, (_, k) => {
    const start = 60 * random();
    return { start, end: start + 3 * random(), layer: `l${k % 7}` };
  });
  const { rows } = stacked(items);
  const clashes = items.flatMap((a, i) =>
    items.slice(i + 1).filter((b) => rows.get(a) === rows.get(b) && a.start < b.end - 1e-6 && b.start < a.end - 1e-6),
  );
  assert.equal(clashes.length, 0);
});

test("spans in sight are those that touch it", () => {
  const random = randoms(3);
  const items = Array.from({ length: 300 }, () => {
    const start = 50 * random();
    return { start, end: start + (random() < 0.1 ? 30 : 1) * random() };
  });
  const spans = new Spans(items);
  for (let k = 0; k < 60; k++) {
    const wanted = items.filter(({ start, end }) => start <= k + 1 && end >= k);
    assert.deepEqual(new Set(spans.within(k, k + 1)), new Set(wanted));
  }
});
