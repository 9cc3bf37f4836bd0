/** Playback: a line that is not performed yet, or has changed since, is performed first. */

import { settled } from "../parts/dom.js";
/** @import {Store} from "./store.js" */

const PAUSE = 350; // ms

/** @param {import("./studio.js").Studio} studio store, clock, actions */
export async function playOrPause({ store, clock, actions }) {
  if (clock.playing) {
    clock.pause();
    return;
  }
  if (changed(store)) {
    if (!(await actions.perform(() => clock.rewind()))) return;
  }
  store.set({ dial: null });
  clock.play();
}

/** Whether playing would do anything. @param {Store} store */
export function canPlay(store) {
  return store.get("take") !== null || (written(store) && store.get("link") === "up");
}

/**
 * Perform the draft in advance after a pause in typing, so that it plays at once.
 * @param {import("./studio.js").Studio} studio store, actions
 */
export function prepareWhatIsWritten({ store, actions }) {
  const prepare = settled(() => {
    if (store.get("link") === "up" && store.get("choices") && changed(store)) actions.prepare();
  }, PAUSE);
  store.watch(["source", "emotions", "choices"], prepare);
}

/** @param {Store} store */
function written(store) {
  const { script, recording } = store.get("source");
  return script.trim() !== "" || recording !== null;
}

/** Whether the draft differs from the performed text and settings. @param {Store} store */
function changed(store) {
  const made = store.get("take")?.made;
  if (!written(store)) return false;
  return !made || JSON.stringify(made.source) !== JSON.stringify(store.get("source"));
}
