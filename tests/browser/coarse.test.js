import assert from "node:assert/strict";
import { test } from "node:test";
import { coarser, lighterOf } from "../../src/risorius/browser/stage/coarse.js";
import { computeNormals } from "../../src/risorius/browser/stage/normals.js";
import * as THREE from "../../src/risorius/browser/vendor/three/three.module.min.js";
import { near } from "./helpers.js";

/** A square of 20 by 20 mm with a vertex each millimetre, made coarser. @param {number} reach */
function grid(reach) {
  /** @type {number[][]} */
  const [points, triangles] = [[], []];
  for (let y = 0; y <= 20; y++) for (let x = 0; x <= 20; x++) points.push(x, y, 0);
  for (let y = 0; y < 20; y++) {
    for (let x = 0; x < 20; x++) {
      const k = 21 * y + x;
      triangles.push(k, k + 1, k + 22, k, k + 22, k + 21);
    }
  }
  const { order, index } = coarser(points, Uint32Array.from(triangles), () => reach);
  const places = order.map((vertex) => points.slice(3 * vertex, 3 * vertex + 3));
  return { places, index };
}

/** @param {ReturnType<typeof grid>} mesh */
function area({ places, index }) {
  let sum = 0;
  for (let k = 0; k < index.length; k += 3) {
    const [a, b, c] = [...index.subarray(k, k + 3)].map((vertex) => places[vertex]);
    sum += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  return sum;
}

test("a coarser mesh covers what the fine one does", () => {
  const mesh = grid(3);
  near([area(mesh)], [400], 1e-6);
  assert.ok(mesh.index.length / 3 < 300);
});

test("a mesh whose vertices gather none is the same", () => {
  const mesh = grid(0);
  near([area(mesh)], [400], 1e-6);
  assert.deepEqual([mesh.index.length / 3, mesh.places.length], [800, 441]);
});

test("the border of a coarser mesh stays", () => {
  assert.equal(grid(5).places.filter(([x, y]) => x % 20 === 0 || y % 20 === 0).length, 80);
});

test("coarse skin has its vertices where lashes darken it: with fewer their shade was drawn as dark spikes on the lids", () => {
  const geometry = new THREE.PlaneGeometry(20, 20, 20, 20);
  const index = new THREE.BufferAttribute(Uint32Array.from(/** @type {THREE.BufferAttribute} */ (geometry.index).array), 1);
  const skin = new THREE.Mesh(geometry.setIndex(index), new THREE.MeshBasicMaterial());
  const spots = { eyes: [[0, 0, -15]], edges: [[0, 0, 0]], mouth: [0, -80, 0] };
  const found = lighterOf("skin", /** @type {any} */ (skin), spots)?.mesh.geometry.attributes.position.array ?? [];
  const away = Array.from({ length: found.length / 3 }, (_, k) => Math.hypot(found[3 * k], found[3 * k + 1]));
  assert.equal(away.filter((distance) => distance < 2.5).length, 21);
  assert.ok(away.length < 300);
});

test("normals stand on their triangles", () => {
  const normals = new Float32Array(12);
  computeNormals(Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9]), Uint32Array.from([0, 1, 2]), normals);
  near(normals, [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0]);
});
