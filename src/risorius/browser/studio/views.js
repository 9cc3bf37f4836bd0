/** Controls over the stage: camera buttons, keys on the picture, names of the heads, notes on progress. */

import { VIEWS } from "../stage/cameras.js";
import { graphics } from "../stage/graphics.js";
import { button } from "../parts/fields.js";
import { fill, make, there } from "../parts/dom.js";
import { glyph } from "../parts/glyphs.js";
/** @import {Store} from "./store.js" */
/** @import {Studio} from "./studio.js" */

const STEP = 8; // degrees a key turns the head by
const ZOOM = 1.1;
const PATIENCE = 400; // ms for which a face may be missing before the page says so

/** @param {HTMLElement} element @param {HTMLElement} note @param {HTMLElement} names @param {import("./studio.js").Studio} studio */
export function mountViews(element, note, names, studio) {
  const { store, view } = studio;
  const cameras = Object.entries(VIEWS).map(([name, { label }], place) => {
    const camera = button(label, { title: `${label} (${place + 1})`, onclick: () => view.choose(name) });
    return { name, camera };
  });
  element.append(...cameras.map(({ camera }) => camera));
  const showCamera = () => {
    const now = view.name;
    for (const { name, camera } of cameras) camera.setAttribute("aria-pressed", String(name === now));
  };
  element.append(fullScreen(there("stage")));
  view.onmove(showCamera);
  showCamera();
  there("head").addEventListener("keydown", (event) => turnByKeys(event, view));
  store.watch(["other", "dial"], () => {
    const other = store.get("other");
    const labels = other ? [store.get("dial") ? "dials" : "this take", other.label] : [];
    fill(names, ...labels.map((label) => make("span", {}, make("b", {}, label))));
  });
  mountNote(note, studio);
  mountReason(element);
}

/** Return the full-screen button. @param {HTMLElement} stage */
function fullScreen(stage) {
  const label = "Full screen (F)";
  const shown = () => document.fullscreenElement === stage;
  const act = () => toggleFullScreen(stage);
  const wide = button(glyph("full"), { id: "full-screen", "aria-label": label, "aria-pressed": "false", title: label, onclick: act });
  document.addEventListener("fullscreenchange", () => wide.setAttribute("aria-pressed", String(shown())));
  return wide;
}

/** Turn full screen on or off. @param {HTMLElement} stage */
export function toggleFullScreen(stage) {
  const done = document.fullscreenElement ? document.exitFullscreen() : stage.requestFullscreen();
  done.catch(() => {}); // where the browser does not allow it, nothing happens
}

/** The reason to show when the server draws the pictures. @type {Record<import("../stage/graphics.js").Graphics, string>} */
const REASONS = {
  card: "",
  coarse: "",
  processor: "No graphics card: the server draws draft pictures.",
  none: "This browser has no WebGL 2: the server draws draft pictures.",
};

/** Show why the stage shows pictures drawn by the server. @param {HTMLElement} element */
function mountReason(element) {
  const reason = REASONS[graphics()];
  if (reason) element.after(make("p", { id: "drawn-by" }, reason));
}

/** @param {HTMLElement} note @param {Studio} studio */
function mountNote(note, { store, clock, headPlayers }) {
  let missingSince = 0;
  store.watch(["take", "dial", "busy", "catalogue"], show);
  clock.on("tick", show);
  setInterval(() => missingSince && show(), PATIENCE);

  function show() {
    const behind = store.get("dial") === null && headPlayers.behind;
    missingSince = behind ? missingSince || performance.now() : 0;
    const late = missingSince > 0 && performance.now() - missingSince > PATIENCE;
    const text = late ? "Loading the face …" : emptyNote(store);
    if (note.textContent !== text) note.textContent = text;
  }
}

/** @param {Store} store */
function emptyNote(store) {
  if (!store.get("catalogue") || store.get("take") || store.get("dial")) return "";
  return store.get("busy") || "Write a line and perform it, or play an example.";
}

/** Turn and zoom by keys. @param {KeyboardEvent} event @param {import("../stage/cameras.js").View} view */
export function turnByKeys(event, view) {
  const act = {
    ArrowLeft: () => view.orbit(-STEP, 0),
    ArrowRight: () => view.orbit(STEP, 0),
    ArrowUp: () => view.orbit(0, STEP),
    ArrowDown: () => view.orbit(0, -STEP),
    "+": () => view.zoom(1 / ZOOM),
    "=": () => view.zoom(1 / ZOOM),
    "-": () => view.zoom(ZOOM),
  }[event.key];
  if (!act || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  act();
}
