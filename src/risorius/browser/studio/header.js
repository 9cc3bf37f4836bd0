/** The page's header: state, undo and redo, theme, help. */

import { button } from "../parts/fields.js";
import { fill, make } from "../parts/dom.js";
import { showHints } from "./example.js";
import { isDraft } from "./drafts.js";
import { glyph } from "../parts/glyphs.js";
import { liveSwitch } from "./live.js";
import { switchTheme } from "../parts/theme.js";
/** @import {Store} from "./store.js" */
/** @import {GlyphName} from "../parts/glyphs.js" */

/**
 * @param {HTMLElement} tools @param {HTMLElement} state @param {import("./studio.js").Studio} studio
 * @returns {{open: () => void, list: (keys: {keys: string, does: string}[]) => void}} the help
 */
export function mountHeader(tools, state, studio) {
  const { store, actions } = studio;
  /** @param {GlyphName} name @param {string} label @param {() => void} act */
  const tool = (name, label, act) =>
    button(glyph(name), { class: "plain icon", id: name, "aria-label": label, title: label, onclick: act });
  const undo = tool("undo", "Undo", () => actions.undo());
  const redo = tool("redo", "Redo", () => actions.redo());
  const keys = make("dl", { class: "keys" });
  const dialog = make(
    "dialog",
    { "aria-label": "Keys" },
    make("h2", {}, "Keys"),
    keys,
    make(
      "form",
      { method: "dialog", class: "row" },
      make("button", { class: "primary" }, "Close"),
      make("button", { id: "show-hints", onclick: () => setTimeout(showHints) }, "Show the hints"),
    ),
  );
  const open = () => dialog.showModal();
  tools.append(undo, redo, liveSwitch(studio), tool("theme", "Light or dark", switchTheme), tool("help", "Keys", open), dialog);
  store.watch(["take"], () => {
    showStep(undo, "Undo", store.get("take")?.undoes, "Ctrl Z");
    showStep(redo, "Redo", store.get("take")?.redoes, "Ctrl Shift Z");
  });
  const stop = button("Stop", { id: "stop", title: "Stop performing", onclick: () => actions.stop() });
  state.after(stop);
  store.watch(["link", "saved", "busy", "take", "draft", "catalogue"], () => showState(state, store));
  store.watch(["stoppable"], () => {
    stop.hidden = !store.get("stoppable");
  });
  /** @param {{keys: string, does: string}[]} known */
  const list = (known) =>
    fill(
      keys,
      ...known.flatMap((key) => [make("dt", {}, make("kbd", {}, key.keys)), make("dd", {}, key.does)]),
    );
  return { open, list };
}

/** @param {HTMLButtonElement} tool @param {string} name @param {string | undefined} what @param {string} keys */
function showStep(tool, name, what, keys) {
  tool.disabled = !what;
  const label = what ? `${name}: ${what}` : name;
  tool.setAttribute("aria-label", label);
  tool.title = `${label} (${keys})`;
}

/** @param {HTMLElement} element @param {Store} store */
function showState(element, store) {
  const [kind, text] = stateOf(store);
  element.dataset.kind = kind;
  element.textContent = text;
}

/** @param {Store} store @returns {[kind: string, text: string]} */
function stateOf(store) {
  if (store.get("link") === "down") {
    return store.get("catalogue")
      ? ["bad", "The server does not answer; trying again …"]
      : ["", "Starting …"];
  }
  if (store.get("busy")) return ["", store.get("busy")];
  const saved = store.get("saved");
  if (saved !== "saved" && saved !== "saving") return ["bad", saved];
  if (saved === "saving" || store.get("draft") === "saving") return ["", "Saving …"];
  return ["", store.get("take") || isDraft(store) ? "All changes saved" : ""];
}
