/** What lies over the stage: buttons for the cameras, keys on the picture, and a line while it is empty. */

import { VIEWS } from "./stage/cameras.js";
import { button } from "./parts/fields.js";

const STEP = 8; // degrees a key turns the head by
const ZOOM = 1.1;

/** @param {HTMLElement} element @param {HTMLElement} empty @param {object} studio */
export function mountViews(element, empty, { store, view }) {
  Object.entries(VIEWS).forEach(([name, { label }], place) => {
    element.append(button(label, { title: `${label} (${place + 1})`, onclick: () => view.choose(name) }));
  });
  document.getElementById("head").addEventListener("keydown", (event) => turn(event, view));
  store.watch(["take", "dial", "busy", "link", "catalogue"], () => {
    const nothing = store.get("take") === null && store.get("dial") === null;
    const performing = nothing && store.get("busy");
    empty.textContent = performing || (nothing && store.get("catalogue") ? "Write a line, then perform it." : "");
  });
}

function turn(event, view) {
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
