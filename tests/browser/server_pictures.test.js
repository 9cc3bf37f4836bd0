import assert from "node:assert/strict";
import { test } from "node:test";
import { Newest, fetchPicture, pictureQuery } from "../../src/risorius/browser/stage/server_pictures.js";

const SIZE = { width: 800, height: 400 };

test("a query says who is seen, from where, and the face's values", () => {
  const camera = { eye: [0, 0.01, 1], target: [0, 0, 0.03], field: 18 };
  const query = new URLSearchParams(pictureQuery({ head: "mei", age: null, hair: "bob" }, [0, 0.123456], SIZE, camera));
  assert.deepEqual(Object.fromEntries(query), {
    head: "mei", hair: "bob", width: "720", eye: "0,10,1000", target: "0,0,30", field: "18", values: "0,0.123",
  }); // prettier-ignore
  assert.equal(pictureQuery({}, null, SIZE, null), "width=720");
});

test("one picture is in flight at a time, and the newest wish wins", async () => {
  /** @type {number[]} */
  const begun = [];
  /** @type {(() => void)[]} */
  const ends = [];
  const newest = new Newest((/** @type {number} */ wish) => {
    begun.push(wish);
    return new Promise((go) => ends.push(() => go(undefined)));
  });
  for (let wish = 0; wish < 100; wish++) newest.ask(wish);
  assert.deepEqual(begun, [0]);
  ends[0]();
  await new Promise((go) => setImmediate(go));
  assert.deepEqual(begun, [0, 99]);
  ends[1]();
  await new Promise((go) => setImmediate(go));
  newest.ask(100);
  assert.deepEqual(begun, [0, 99, 100]);
});

test("a busy server is asked again, a refusal is told", async (/** @type {any} */ t) => {
  const answers = [new Response("", { status: 503 }), new Response("unknown head\n", { status: 400 })];
  /** @type {any[]} */
  const asked = [];
  t.mock.method(globalThis, "fetch", async (/** @type {any[]} */ ...given) => {
    asked.push(given);
    return answers.shift();
  });
  await assert.rejects(fetchPicture("head=x", "secret"), /^Error: unknown head$/);
  assert.equal(asked.length, 2);
  assert.deepEqual(asked[0], ["/picture.webp?head=x", { headers: { authorization: "Bearer secret" } }]);
});
