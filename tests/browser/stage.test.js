import assert from "node:assert/strict";
import { test } from "node:test";
import { woven } from "../../src/risorius/browser/player/data.js";
import { VIEWS, View } from "../../src/risorius/browser/stage/cameras.js";
import { readGlb } from "../../src/risorius/browser/stage/glb.js";
import { near } from "./helpers.js";

test("a view is one of those with a name until it is turned", () => {
  let changes = 0;
  const view = new View(() => (changes += 1));
  view.fit(800, 600);
  assert.equal(view.name, "front");
  view.choose("side");
  assert.deepEqual([view.name, changes], ["side", 1]);
  view.orbit(10, 500);
  assert.deepEqual([view.name, view.state.tilt], [null, 80]);
  view.zoom(1e9);
  assert.equal(view.state.height, 0.9);
});

test("the camera looks at the centre, from where the view's height is seen", () => {
  const view = new View(() => {});
  view.fit(1000, 500);
  view.choose("front");
  const { camera } = view;
  const distance = Math.hypot(camera.position.x, camera.position.y, camera.position.z - 0.03);
  near([2 * distance * Math.tan((camera.fov * Math.PI) / 360)], [VIEWS.front.height]);
  view.fit(410, 1000); // narrow: as much again across
  const far = camera.position.z - 0.03;
  near([far / distance], [2], 1e-6);
});

test("a head's file is read: meshes by name, their attributes and triangles", () => {
  const points = Float32Array.from([0, 1, 2, 3, 4, 5, 6, 7, 8]);
  const index = Uint32Array.from([0, 1, 2]);
  const json = JSON.stringify({
    meshes: [{ name: "skin", primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
    materials: [{ name: "skin" }],
    nodes: [{ name: "head" }],
    bufferViews: [{ byteOffset: 0, byteLength: 36 }, { byteOffset: 36, byteLength: 12 }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 3, type: "VEC3" },
      { bufferView: 1, componentType: 5125, count: 3, type: "SCALAR" },
    ],
  });
  const text = new TextEncoder().encode(json.padEnd(Math.ceil(json.length / 4) * 4));
  const file = new Uint8Array(20 + text.length + 8 + 48);
  new DataView(file.buffer).setUint32(12, text.length, true);
  file.set(text, 20);
  file.set(new Uint8Array(points.buffer), 28 + text.length);
  file.set(new Uint8Array(index.buffer), 28 + text.length + 36);
  const { meshes, nodes } = readGlb(file.buffer);
  assert.deepEqual([...meshes.skin.attributes.POSITION.array], [...points]);
  assert.deepEqual([meshes.skin.attributes.POSITION.width, [...meshes.skin.index], nodes[0].name], [3, [0, 1, 2], "head"]);
});

test("bytes of which all first ones of four come first are put in order", () => {
  const planes = Uint8Array.from([1, 5, 2, 6, 3, 7, 4, 8]);
  assert.deepEqual([...new Uint8Array(woven(planes.buffer))], [1, 2, 3, 4, 5, 6, 7, 8]);
});
