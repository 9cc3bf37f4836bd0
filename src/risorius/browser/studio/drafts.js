/**
 * The draft: text and settings that are not performed yet. The server and this tab both keep it: it must
 * survive a reload, a lost connection, undo, and a take that another tab performs.
 */

import { settled } from "../parts/dom.js";
/** @import {Store} from "./store.js" */
/** @import {Studio} from "./studio.js" */
/** @import {Written} from "../types.js" */

/** @type {("source" | "choices" | "emotions")[]} */
export const PARTS = ["source", "choices", "emotions"];

/** The empty draft. @type {Pick<import("./store.js").Parts, "source" | "emotions">} */
export const NOTHING = { source: { script: "", format: "text", recording: null, edges: [] }, emotions: [] };

const WAIT = 600; // ms after the last letter until the draft is sent
const KEY = "risorius-draft";

/** Whether two parts of the store are equal. @param {unknown} a @param {unknown} b */
export const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/** The parts of the store that a take is made from. @param {Store} store @returns {Written} */
export function written(store) {
  return { source: store.get("source"), choices: store.get("choices"), emotions: store.get("emotions") };
}

/**
 * Whether the draft differs from the performed text and settings (or from an empty draft, before the first take).
 * @param {Store} store
 */
export function isDraft(store) {
  const made = store.get("take")?.made;
  if (made) return PARTS.some((name) => !same(store.get(name), made[name]));
  const { script, recording } = store.get("source");
  return script !== "" || recording !== null || store.get("emotions").length > 0;
}

/**
 * Return the parts of `now` that replace those in the store: parts that the user has changed since stay.
 * @param {import("./store.js").Store} store
 * @param {Record<string, any> | undefined} before source of the previous take
 * @param {Record<string, any>} now source of the new take
 * @param {Record<string, any>} [asked] the parts that were sent with the request
 */
export function adopted(store, before, now, asked = {}) {
  const names = PARTS.filter((name) => {
    const own = store.get(name);
    return !same(own, now[name]) && (own === asked[name] || (before && same(own, before[name])));
  });
  return Object.fromEntries(names.map((name) => [name, now[name]]));
}

/** Show the performed text; the draft is put aside and can be restored. @param {Store} store */
export function putAside(store) {
  if (!isDraft(store)) return;
  store.set({ aside: written(store), ...(store.get("take")?.made ?? NOTHING) });
}

/** Restore the draft that was put aside. @param {Store} store */
export function bringBack(store) {
  const aside = store.get("aside");
  if (aside) store.set({ aside: null, ...aside });
}

/**
 * Save the draft: in this tab at once, on the server after a pause in typing. Call it when the
 * session is open; before that there is no draft.
 * @param {Studio} studio
 */
export function keepDraft({ store, connection }) {
  let waits = false; // whether the draft is not sent yet
  const tell = () => {
    if (store.get("link") !== "up") return; // it is sent when the session opens again
    waits = false;
    /** @param {"saved" | "saving"} draft */
    const done = (draft) => store.get("draft") === "saving" && store.set({ draft });
    connection.request("save_draft", written(store)).then(
      () => done("saved"),
      () => done("saving"),
    );
  };
  const send = settled(tell, WAIT);
  addEventListener("pagehide", () => waits && tell());
  let known = "null";
  const keep = () => {
    const now = JSON.stringify(isDraft(store) ? written(store) : null);
    if (now === known) return;
    known = now;
    remember(store.get("session"), now);
    store.set({ draft: "saving" });
    waits = true;
    send();
  };
  store.watch([...PARTS, "take"], keep);
  store.watch(["link"], () => known !== "null" && send());
}

/** @param {string} session @param {string} text */
function remember(session, text) {
  try {
    if (text === "null") sessionStorage.removeItem(`${KEY}-${session}`);
    else sessionStorage.setItem(`${KEY}-${session}`, text);
  } catch {
    // A text too long for the tab's store is still kept by the server.
  }
}

/**
 * Return the draft that this tab had when it was left; settings that no longer exist are left out.
 * @param {string} session @param {Record<string, any>} choices all that there are
 */
export function remembered(session, choices) {
  try {
    const draft = JSON.parse(sessionStorage.getItem(`${KEY}-${session}`) ?? "null");
    if (draft === null) return null;
    const kept = Object.entries(draft.choices).filter(([name]) => name in choices);
    return { ...draft, choices: { ...choices, ...Object.fromEntries(kept) } };
  } catch {
    return null;
  }
}
