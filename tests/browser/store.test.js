import assert from "node:assert/strict";
import { test } from "node:test";
import { adopted, isDraft } from "../../src/risorius/browser/studio/drafts.js";
import { Store } from "../../src/risorius/browser/studio/store.js";

/** @param {Record<string, unknown>} parts */
const storeOf = (parts) => new Store(/** @type {any} */ (parts));
const WRITTEN = { source: { script: "Hello.", recording: null }, emotions: [], choices: {} };

test("who watches is told once, after all parts are in place", () => {
  const store = storeOf({ tab: "a", busy: "" });
  /** @type {string[]} */
  const heard = [];
  const end = store.watch(["tab", "busy"], () => heard.push(store.get("tab") + store.get("busy")));
  store.set({ tab: "b", busy: "!" });
  store.set({ tab: "b" });
  end();
  store.set({ tab: "c" });
  assert.deepEqual(heard, ["a", "b!"]);
});

test("what is written is a draft until it is performed", () => {
  assert.equal(isDraft(storeOf({ ...WRITTEN, source: { script: "", recording: null }, take: null })), false);
  assert.equal(isDraft(storeOf({ ...WRITTEN, take: null })), true);
  assert.equal(isDraft(storeOf({ ...WRITTEN, take: { made: structuredClone(WRITTEN) } })), false);
  assert.equal(isDraft(storeOf({ ...WRITTEN, take: { made: { ...WRITTEN, choices: { head: "mei" } } } })), true);
});

test("what the user has written since stays", () => {
  const now = { ...WRITTEN, choices: { head: "mei" }, source: { script: "Bye.", recording: null } };
  const store = storeOf({ ...WRITTEN, source: { script: "Mine.", recording: null } });
  assert.deepEqual(adopted(store, WRITTEN, now), { choices: { head: "mei" } });
});
