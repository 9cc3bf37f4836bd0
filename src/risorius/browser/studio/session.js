/** The session: its name in the address, its state when the socket opens, and the sound of the clock. */

import { NOTHING, adopted, isDraft, keepDraft, remembered } from "./drafts.js";
import { settled } from "../parts/dom.js";
import { takeOf } from "../player/take.js";
/** @import {Store} from "./store.js" */
/** @import {Studio} from "./studio.js" */
/** @import {PageView} from "../wire.js" */

const KEY = "risorius-session";
const NAME = /^[a-z0-9][a-z0-9-]{0,39}$/;
const WAIT = 600; // ms after which the page's view is saved with the project

/** @returns {string} the session in the address, else the last open one, else a new one */
export function sessionName() {
  const asked = location.hash.slice(1);
  const known = localStorage.getItem(KEY) ?? "";
  const name =
    [asked, known].find((found) => NAME.test(found)) ?? `session-${crypto.randomUUID().slice(0, 8)}`;
  localStorage.setItem(KEY, name);
  history.replaceState(null, "", `#${name}`);
  return name;
}

/** Open the session now and after every reconnection, and keep the clock and the page in step with it. @param {Studio} studio */
export function openSession(studio) {
  const { store, connection, clock, notify } = studio;
  window.addEventListener("hashchange", () => location.reload());
  const again = () => open(studio).catch((error) => notify(error.message));
  connection.on("up", again);
  connection.on("changed", again);
  connection.on("down", () => store.set({ link: "down" }));
  connection.on("saved", ({ error }) => store.set({ saved: error ? `Not saved: ${error}` : "saved" }));
  store.watch(["take"], () => {
    const take = store.get("take");
    clock.load({ duration: take?.duration ?? 0, fps: take?.rate ?? 30, sound: take?.speech?.sound ?? null });
  });
  keepView(studio);
}

/** @param {Studio} studio */
async function open(studio) {
  const { store, connection, notify } = studio;
  if (!store.get("catalogue")) await loadCatalogue(store);
  const state = await connection.request("open");
  const { recordings, poses, emotions: ownEmotions } = state;
  const [before, first] = [store.get("take"), !studio.opened];
  const take = state.take && takeOf(state.take);
  const draft = first
    ? { ...take?.made, ...(remembered(store.get("session"), store.get("choices")) ?? state.draft) }
    : take && adopted(store, before?.made ?? NOTHING, take.made);
  store.set({ link: "up", saved: "saved", recordings, poses, ownEmotions, take, faces: null, ...draft });
  if (first) {
    studio.opened = true;
    keepDraft(studio);
    showView(studio, state.view);
  } else if (take?.take !== before?.take && isDraft(store)) {
    notify("Another page changed this session. Your draft is kept.");
  }
  for (const line of state.notes) notify(line);
}

/** @param {Store} store */
async function loadCatalogue(store) {
  const catalogue = await (await fetch("/api/catalogue")).json();
  store.set({ catalogue, choices: store.get("choices") ?? catalogue.choices });
}

/** Save the page's view with the project: panel, camera, playhead. @param {Studio} studio */
function keepView({ store, connection, clock, view }) {
  const keep = settled(() => {
    if (store.get("link") !== "up" || store.get("take") === null || clock.playing) return;
    const [tab, graphs] = [store.get("tab"), store.get("graphs")];
    const shown = { tab, graphs, camera: view.state, time: clock.time };
    connection.request("save_view", { view: shown }).catch(() => {});
  }, WAIT);
  store.watch(["tab", "graphs"], keep);
  clock.on("tick", keep);
  view.onmove(keep);
}

/** @param {Studio} studio @param {PageView} view */
function showView({ store, view, clock, openTab }, { tab, camera, time, graphs }) {
  if (tab) openTab?.(tab);
  if (camera) view.state = camera;
  if (time) clock.seek(time);
  if (graphs) store.set({ graphs });
}
