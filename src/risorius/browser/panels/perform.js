/** The line or recording to perform, its emotions, and all settings. */

import { button, choice, field } from "../parts/fields.js";
import { make } from "../parts/dom.js";
import { mountChoices } from "./choices.js";
import { mountDraft } from "./draft.js";
import { mountEmotions } from "./emotions.js";
import { mountLost } from "./lost.js";
import { mountRecording } from "./recording.js";
import { mountScript } from "./script.js";
import { mountTags } from "./tags.js";
/** @import {Studio} from "../studio/studio.js" */
/** @import {Parts} from "../studio/store.js" */

/** @param {HTMLElement} element @param {import("../studio/studio.js").Studio} studio */
export function mountPerform(element, studio) {
  const { store, actions } = studio;
  const script = mountScript(studio);
  const form = make("div", { class: "stack" });
  const perform = button("Perform", { class: "primary", id: "perform", onclick: () => actions.perform() });
  const foot = make(
    "div",
    { class: "panel-foot" },
    perform,
    make("span", { class: "hint" }, make("kbd", {}, "Ctrl"), " ", make("kbd", {}, "Enter")),
  );
  element.append(script.element, mountTags(studio), mountDraft(studio), mountLost(studio), mountRecording(studio), mountEmotions(studio, script), form, foot);
  const ready = store.watch(["catalogue"], () => {
    if (!store.get("catalogue")) return;
    form.append(formatField(studio));
    mountChoices(form, studio);
    ready?.();
  });
  store.watch(["busy", "source", "link"], () => {
    const { script: text, recording } = store.get("source");
    perform.disabled = store.get("link") !== "up" || (text.trim() === "" && recording === null);
  });
}

/** @param {Studio} studio */
function formatField({ store }) {
  const options = store
    .get("catalogue")
    .formats.map((name) => ({ name, title: name === "text" ? "plain text" : name }));
  /** @param {string | null} name */
  const change = (name) => {
    const format = /** @type {Parts["source"]["format"]} */ (name);
    store.set({ source: { ...store.get("source"), format } });
  };
  const list = choice(options, { value: store.get("source").format, change });
  store.watch(["source"], () => list.show(store.get("source").format));
  const row = field("Written as", list, { hint: "Format of the script" });
  row.dataset.choice = "format";
  return row;
}
