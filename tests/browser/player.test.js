import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { KINDS, unpackFaces } from "../../src/risorius/browser/stage/faces.js";
import { Player } from "../../src/risorius/browser/studio/player.js";

/** A player of 300 s whose server answers when the test has it answer. */
function scrubbed() {
  /** @type {[string, number | null][]} */
  const asked = [];
  /** @type {number[]} */
  const shown = [];
  /** @type {((answer?: unknown) => void)[]} */
  const answers = [];
  const connection = {
    up: true,
    on() {},
    /** @param {string} verb @param {{first?: number, time?: number}} fields */
    request: (verb, { first, time }) => {
      asked.push([verb, first ?? (time === undefined ? null : Math.round(30 * time))]);
      return new Promise((go) => answers.push(go));
    },
  };
  const clock = { time: 0, playing: false, on() {} };
  const player = new Player(/** @type {any} */ (connection), /** @type {any} */ (clock), (/** @type {any} */ a) => shown.push(a.name));
  player.load({ take: 1, frames: 9000, rate: 30 });
  /** @param {number} time */
  const seek = (time) => {
    clock.time = time;
    player.update();
  };
  /** @param {number} first @param {number} [kind] */
  const send = (first, kind = KINDS.take) => player.receive(/** @type {any} */ ({ kind, take: 1, first, faces: [{ name: first }] }));
  return { asked, shown, answers, player, seek, send };
}

test("who scrubs sees one face after another, and all where the hand rests", async (/** @type {any} */ t) => {
  mock.timers.enable({ apis: ["setTimeout"] });
  t.after(() => mock.timers.reset());
  let now = 1000;
  t.mock.method(performance, "now", () => now);
  const { asked, shown, answers, seek, send } = scrubbed();
  [100, 150, 200].forEach(seek);
  send(3000, KINDS.moment);
  answers[2]();
  await new Promise((go) => setImmediate(go));
  send(6000, KINDS.moment);
  answers[3]();
  send(0); // of the stretch that the take begins with: it is not where the playhead is
  await new Promise((go) => setImmediate(go));
  now += 700;
  mock.timers.tick(700);
  send(6000);
  assert.deepEqual(asked, [["faces", 0], ["cancel", null], ["face_at", 3000], ["face_at", 6000], ["faces", 6000]]);
  assert.deepEqual(shown, [3000, 6000, 6000]);
});

test("while a change is tried its face is seen, and then the take's own", () => {
  const { shown, player, send } = scrubbed();
  send(0);
  player.previewing = true;
  send(0, KINDS.moment);
  send(1);
  player.update();
  assert.deepEqual(shown, [0, 0]);
  player.previewing = false;
  assert.deepEqual(shown, [0, 0, 0]);
});

test("a message of faces is unpacked", () => {
  const [vertices, pose, count, folds] = [2, 14, 2, 3];
  const buffer = new ArrayBuffer(4 * (6 + count * pose) + 6 * vertices * count + folds * count);
  new Uint32Array(buffer, 0, 6).set([KINDS.take, 5, 30, count, vertices, pose]);
  new Float32Array(buffer, 24, count * pose).set(Array.from({ length: count * pose }, (_, k) => k));
  new Int16Array(buffer, 24 + 4 * count * pose, 3 * vertices * count).fill(7);
  const { kind, take, first, faces } = unpackFaces(buffer);
  assert.deepEqual([kind, take, first, faces.length], [KINDS.take, 5, 30, 2]);
  assert.deepEqual([...faces[1].head], [14, 15, 16, 17]);
  assert.deepEqual([faces[1].jaw, faces[1].lips, faces[1].points.length, faces[1].folds.length], [26, 27, 6, 3]);
});
