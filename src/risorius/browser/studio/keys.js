/** Keys that work everywhere on the page except in text fields; `help` lists them. */

import { there } from "../parts/dom.js";
import { playOrPause } from "./playing.js";
import { toggleLoop } from "./transport.js";
import { toggleFullScreen } from "./views.js";
import { VIEWS } from "../stage/cameras.js";

/**
 * @param {import("./studio.js").Studio} studio clock, actions, view
 * @param {() => void} help shows the list of keys
 * @returns {{keys: string, does: string}[]} the list
 */
export function listenToKeys(studio, help) {
  const { clock, actions, view } = studio;
  const cameras = Object.entries(VIEWS).map(([name, { label }], place) => {
    /** @type {[string, string, string, () => void]} */
    const key = [String(place + 1), String(place + 1), `Camera: ${label.toLowerCase()}`, () => view.choose(name)];
    return key;
  });
  /** @type {[string, string | null, string, () => void][]} */
  const shortcuts = [
    [" ", "Space", "Play or pause", () => playOrPause(studio)],
    ["ArrowLeft", "←", "One frame back", () => clock.step(-1)],
    ["ArrowRight", "→", "One frame forward", () => clock.step(1)],
    ["Shift+ArrowLeft", "Shift ←", "One second back", () => clock.seek(clock.time - 1)],
    ["Shift+ArrowRight", "Shift →", "One second forward", () => clock.seek(clock.time + 1)],
    ["Home", "Home", "To the start", () => clock.seek(0)],
    ["End", "End", "To the end", () => clock.seek(clock.duration)],
    ["l", "L", "Loop on or off", () => toggleLoop(clock)],
    ...cameras,
    ["f", "F", "Full screen", () => toggleFullScreen(there("stage"))],
    ["Ctrl+Enter", "Ctrl Enter", "Perform", () => actions.perform()],
    ["Ctrl+z", "Ctrl Z", "Undo", () => actions.undo()],
    ["Ctrl+Shift+z", "Ctrl Shift Z", "Redo", () => actions.redo()],
    ["Ctrl+y", null, "Redo", () => actions.redo()],
    ["?", "?", "These keys", help],
  ];
  const acts = new Map(shortcuts.map(([key, , , act]) => [key, act]));
  document.addEventListener("keydown", (event) => {
    const act = acts.get(pressed(event));
    if (!act || event.defaultPrevented || !free(event)) return;
    event.preventDefault();
    act();
  });
  return shortcuts.flatMap(([, keys, does]) => (keys ? [{ keys, does }] : []));
}

/** @param {KeyboardEvent} event @returns {string} such as "Ctrl+Shift+z" */
function pressed(event) {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const shift = event.shiftKey && key !== "?";
  return `${event.ctrlKey || event.metaKey ? "Ctrl+" : ""}${shift ? "Shift+" : ""}${key}`;
}

/** Whether the page handles a key: not if the focused element uses it. @param {KeyboardEvent} event */
function free(event) {
  const element = /** @type {Element} */ (event.target);
  const key = pressed(event);
  if (key === "Ctrl+Enter") return true;
  if (element.closest?.("dialog[open]")) return false;
  if (
    element.matches?.("textarea, input:not([type=range], [type=checkbox], [type=radio], [type=file]), select")
  ) {
    return false;
  }
  if (element.matches?.("input[type=range]:not(.scrub)") && /Arrow|Home|End/.test(key)) return false;
  if (element.matches?.("canvas, [role=separator]") && /Arrow/.test(key)) return false;
  return !(key === " " && element.matches?.("button:not(#play), summary, input, a, [role=tab]"));
}
