import assert from "node:assert/strict";
import { test } from "node:test";
import { Cover } from "../../src/risorius/browser/stage/cover.js";
import { Order, asStrands, fewer } from "../../src/risorius/browser/stage/strands.js";
import * as THREE from "../../src/risorius/browser/vendor/three/three.module.min.js";
import { near } from "./helpers.js";

const QUAD = [0, 1, 2, 1, 3, 2];

/** @param {number[]} points @param {number[]} index */
function geometryOf(points, index) {
  const geometry = new THREE.BufferGeometry().setIndex(new THREE.BufferAttribute(Uint32Array.from(index), 1));
  return geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(points), 3));
}

for (const { length, bends } of [
  { length: 20, bends: [0, 1, 8, 9, 14, 15] },
  { length: 200, bends: [0, 1, 2, 3, 4, 5, 6, 7, 10, 11, 14, 15] },
]) {
  test(`fewer strands of ${length} mm keep root and tip, and long ones most of their bends`, () => {
    const [strands, pairs] = [100, 8];
    /** @type {number[][]} */
    const [index, points] = [[], []];
    for (let s = 0; s < strands; s++) {
      for (let p = 0; p < pairs; p++) {
        const along = (length * p) / (pairs - 1);
        points.push(0, along, s, 1, along, s);
        if (p < pairs - 1) index.push(...QUAD.map((k) => 2 * (s * pairs + p) + k));
      }
    }
    const found = fewer(Uint32Array.from(index), 0.25, Float32Array.from(points));
    const kept = found.order.length / bends.length;
    assert.ok(Math.abs(kept - 25) <= 2);
    assert.equal(found.index.length / 3, (bends.length - 2) * kept);
    for (let k = 0; k < found.order.length; k += bends.length) {
      assert.deepEqual(found.order.slice(k, k + bends.length).map((v) => v % 16), bends);
    }
  });
}

test("strands farthest from who looks come first and stay whole", () => {
  // Four strands of two pairs, at depths 3, 1, 4 and 2.
  const points = [3, 1, 4, 2].flatMap((z) => [0, 0, z, 1, 0, z, 0, 1, z, 1, 1, z]);
  const geometry = geometryOf(points, [0, 1, 2, 3].flatMap((s) => QUAD.map((k) => 4 * s + k)));
  const order = new Order(geometry);
  for (const [z, expected] of /** @type {[number, number[]][]} */ ([[-1, [1, 3, 0, 2]], [1, [2, 0, 3, 1]]])) {
    order.sort(new THREE.Vector3(0, 0, z));
    const index = [.../** @type {THREE.BufferAttribute} */ (geometry.index).array];
    assert.deepEqual(expected, index.filter((_, k) => k % 6 === 0).map((v) => Math.floor(v / 4)));
    assert.deepEqual(index.map((v) => v % 4), [0, 1, 2, 3].flatMap(() => QUAD));
  }
});

test("strands are left out where the head or other hair hides them", () => {
  // From the front those behind a board or a curtain of hair, but none beside them; from the side none.
  /** @param {number} from @param {number} z @param {number} y */
  const row = (from, z, y) => Array.from({ length: 30 }, (_, k) => [from + 4 * k, y, z]).flat();
  /** @param {number} from @param {number} z */
  const wall = (from, z) => Array.from({ length: 30 }, (_, k) => row(from, z, 4 * k)).flat();
  const cover = new Cover(Float32Array.from(wall(-130, 0)), Float32Array.from(wall(10, 0)));
  // Before and behind the board, behind the curtain, and beside it.
  const places = [[-70, 9], [-70, -9], [-120, -9], [70, -9], [70, -29], [160, -29]];
  const points = places.flatMap(([x, z]) => [40, 60].flatMap((y) => [x, y, z, x + 1, y, z]));
  const geometry = geometryOf(points, places.flatMap((_, s) => QUAD.map((v) => 4 * s + v)));
  const order = new Order(geometry, cover);
  const shown = [[0, 0, -1], [1, 0, 0]].map(([x, y, z]) => {
    order.sort(new THREE.Vector3(x, y, z));
    const { array } = /** @type {THREE.BufferAttribute} */ (geometry.index);
    return places.map((_, s) => Array.from(array).includes(4 * s + 3));
  });
  assert.deepEqual(shown, [[true, false, true, true, false, true], Array(6).fill(true)]);
});

test("strands know where they run and their breadth, by which they turn to who looks", () => {
  // Two strands of three pairs, 2 wide: one runs up, then to the left, the other to the front.
  const one = [-1, 0, 0, 1, 0, 0, -1, 5, 0, 1, 5, 0, -4, 5, 0, -2, 5, 0];
  const other = [0, 1, 2].flatMap((k) => [-1, 9, 3 * k, 1, 9, 3 * k]);
  const geometry = geometryOf([...one, ...other], [0, 2, 6, 8].flatMap((from) => QUAD.map((v) => from + v)));
  asStrands(/** @type {any} */ (new THREE.Mesh(geometry)));
  const [along, breadth, points] = ["along", "breadth", "position"].map((name) => [...geometry.attributes[name].array]);
  /** @param {number[]} way @param {number} count */
  const times = (way, count) => Array.from({ length: count }, () => way).flat();
  near(along, [...times([0, 1, 0], 2), ...times([-1, 0, 0], 4), ...times([0, 0, 1], 6)]);
  // The first of both is never left out, the other where the thinnest hairs are wider than 1 / .618 of it.
  near(breadth, [...times([1, 1e6], 6), ...times([1, 1 / 0.6180339887], 6)], 1e-5);
  near(points.slice(0, 18), [...times([0, 0, 0], 2), ...times([0, 5, 0], 2), ...times([-3, 5, 0], 2)]);
});
