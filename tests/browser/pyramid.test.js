import assert from "node:assert/strict";
import { test } from "node:test";
import { Pyramid } from "../../src/risorius/browser/timeline/model/pyramid.js";

test("a pyramid finds the extremes of any stretch", () => {
  const values = Float32Array.from({ length: 5000 }, (_, k) => Math.sin(k * k));
  const pyramid = new Pyramid(values);
  for (const [first, last] of [[0, 5000], [17, 18], [100, 900], [4000, 4999], [4999, 5000]]) {
    const [low, high] = pyramid.range(first, last);
    const part = values.slice(first, last);
    assert.ok(low <= Math.min(...part) && high >= Math.max(...part), `${first} to ${last}`);
  }
});
