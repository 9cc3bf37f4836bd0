import assert from "node:assert/strict";
import { test } from "node:test";
import { PixelRatio } from "../../src/risorius/browser/stage/pixel_ratio.js";

/** @param {PixelRatio} ratio @param {number} count @param {number} apart ms @param {number} from */
function draw(ratio, count, apart, from) {
  for (let k = 0; k < count; k++) ratio.drew(from + k * apart);
  return from + count * apart;
}

test("fewer pixels are drawn while pictures come too slowly, and more when they are quick", () => {
  const ratio = new PixelRatio();
  let now = draw(ratio, 5, 60, 0);
  assert.equal(ratio.share, 1);
  now = draw(ratio, 1, 60, now);
  assert.equal(ratio.share, 0.75);
  now = draw(ratio, 60, 60, now);
  assert.equal(ratio.share, 0.5);
  now = draw(ratio, 40, 16, now);
  assert.equal(ratio.share, 0.5);
  draw(ratio, 100, 16, now);
  assert.ok(ratio.share > 0.5);
});

test("a pause is not a slow picture", () => {
  const ratio = new PixelRatio();
  draw(ratio, 50, 1000, 0);
  assert.equal(ratio.share, 1);
});
