import assert from "node:assert/strict";
import { test } from "node:test";
import { Viewport } from "../../src/risorius/browser/timeline/model/viewport.js";
import { near } from "./helpers.js";

/** @param {number} width @param {number} duration */
function opened(width, duration) {
  const view = new Viewport();
  view.resize(width, duration);
  view.open();
  return view;
}

test("a take is shown whole, a long one its beginning", () => {
  near([opened(1000, 3).span], [3.04]);
  near([opened(1000, 300).span], [14]);
});

test("pixels and seconds are the same place", () => {
  const view = opened(800, 5);
  near([view.time(view.x(1.7))], [1.7]);
  view.zoom(3, 200);
  near([view.time(view.x(1.7))], [1.7]);
});

test("what the pointer is on stays there when all grows larger", () => {
  const view = opened(800, 50);
  const held = view.time(300);
  view.zoom(2, 300);
  near([view.time(300)], [held]);
});

test("what is brought into sight is in it", () => {
  const view = opened(800, 60);
  assert.equal(view.reveal(2), false);
  assert.equal(view.reveal(40, 41), true);
  assert.ok(view.start <= 40 && view.end >= 41);
});

test("the page turns when the playhead leaves it", () => {
  const view = opened(800, 60);
  assert.equal(view.follow(1), false);
  assert.equal(view.follow(13), true);
  near([(13 - view.start) / view.span], [0.12]);
  view.scrollTo(1e9);
  near([view.end], [60.02]);
});
