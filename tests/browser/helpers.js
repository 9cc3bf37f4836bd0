/** What several tests of the pages' modules need. */

import assert from "node:assert/strict";

/** @param {number} seed @returns {() => number} numbers from 0 to 1 in the same order each time */
export function randoms(seed) {
  let state = seed;
  return () => (state = (state * 16807) % 2147483647) / 2147483647;
}

/** @param {ArrayLike<number>} found @param {ArrayLike<number>} expected @param {number} [tolerance] */
export function near(found, expected, tolerance = 1e-9) {
  assert.equal(found.length, expected.length);
  for (let k = 0; k < expected.length; k++) assert.ok(Math.abs(found[k] - expected[k]) <= tolerance, `${[...Array.from(found)]} is not ${[...Array.from(expected)]}`);
}

/** Columns of a graph that know only what is traced on them. */
export class Trace {
  /** @type {(string | number)[][]} */
  calls = [];

  /** @param {number} x @param {number} y */
  moveTo(x, y) {
    this.calls.push(["move", x, y]);
  }

  /** @param {number} x @param {number} y */
  lineTo(x, y) {
    this.calls.push(["line", x, y]);
  }

  /** @param {number[]} points */
  bezierCurveTo(...points) {
    this.calls.push(["bezier", ...points]);
  }
}
