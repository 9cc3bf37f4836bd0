import assert from "node:assert/strict";
import { test } from "node:test";
import { LiveFace, driving, nodeOf } from "../../src/risorius/browser/live/risorius-live.js";
import * as THREE from "../../src/risorius/browser/vendor/three/three.module.min.js";
import { near } from "./helpers.js";

/** A packed frame as docs/serve.md describes it. @param {number} index @param {number} time @param {number[]} floats */
function packed(index, time, floats) {
  const buffer = new ArrayBuffer(32 + 4 * floats.length);
  const view = new DataView(buffer);
  view.setUint32(4, index, true);
  view.setFloat64(8, time, true);
  view.setUint32(20, 16000, true);
  view.setUint32(24, floats.length, true);
  floats.forEach((value, k) => view.setFloat32(32 + 4 * k, value, true));
  return buffer;
}

/** A face without sound, and its clock. */
function silent() {
  const face = new LiveFace("ws://nowhere", { sound: false, outputs: ["arkit"] });
  const clock = { time: 10 };
  face.now = () => clock.time;
  face.hear({ is: "started", arkit: ["jawOpen", "eyeBlinkLeft"] }, () => {});
  return { face, clock };
}

test("a frame is shown when it is due, until the next one is", () => {
  const { face, clock } = silent();
  for (let k = 0; k < 4; k++) face.take(packed(k, k / 30, [k, 0]));
  assert.equal(face.frame(), null);
  clock.time += 0.5;
  assert.equal(face.frame()?.index, 3);
  near(face.frame()?.values.arkit ?? [], [3, 0]);
});

test("no frame is skipped that is heard, and none is early", () => {
  const { face, clock } = silent();
  for (let k = 0; k < 30; k++) face.take(packed(k, k / 30, [k, 0]));
  for (let step = 0; step < 60; step++) {
    clock.time += 1 / 60;
    const shown = face.frame();
    const now = clock.time - (face.base ?? 0);
    if (shown) assert.ok(shown.time <= now && (shown.index === 29 || shown.time + 1 / 30 > now - 1e-9));
  }
});

test("what is interrupted is forgotten, and the next frame begins anew", () => {
  const { face, clock } = silent();
  face.take(packed(0, 0, [1, 0]));
  face.hear({ is: "interrupted", unsaid: "" }, () => {});
  assert.equal(face.frames.length, 0);
  clock.time += 100;
  face.take(packed(1, 0.1, [1, 0]));
  near([(face.base ?? 0) + 0.1 - clock.time], [0.06 + 0.1 / 30], 1e-6);
});

test("events are told with what the server says", () => {
  const { face } = silent();
  /** @type {any[]} */
  const heard = [];
  for (const kind of ["sentence", "error"]) face.addEventListener(kind, (event) => heard.push([kind, /** @type {CustomEvent} */ (event).detail]));
  face.hear({ is: "sentence", text: "Hi." }, () => {});
  face.hear({ is: "error", message: "no" }, () => {});
  assert.deepEqual(heard.map(([kind]) => kind), ["sentence", "error"]);
  assert.deepEqual([face.text, face.fault], ["Hi.", "no"]);
});

test("a character is driven by the names of its morph targets and nodes", () => {
  const [root, head, eye, mesh] = [new THREE.Group(), new THREE.Group(), new THREE.Group(), new THREE.Mesh()];
  [head.name, eye.name] = ["mixamorig:Head", "eye_left"];
  mesh.morphTargetDictionary = { other: 0, JawOpen: 1, "face.mouthSmileLeft": 2 };
  mesh.morphTargetInfluences = [0.5, 0, 0];
  root.add(head);
  head.add(eye, mesh);
  assert.equal(nodeOf(root, "left"), eye);
  assert.equal(nodeOf(root, "right"), undefined);
  const show = driving(root);
  show(null);
  const names = { arkit: ["mouthSmileLeft", "jawOpen"], rotations: [] };
  const values = { arkit: Float32Array.from([0.25, 0.75]), rotations: Float32Array.from([0.3, 0, 0, 0, 0, 0, 0, 0, 0]) };
  show({ index: 0, time: 0, text: "", names, values });
  near(mesh.morphTargetInfluences, [0.5, 0.75, 0.25]);
  near(new THREE.Vector3(0, 0, 1).applyQuaternion(head.quaternion).toArray(), [Math.sin(0.3), 0, Math.cos(0.3)], 1e-6);
});
