/** Manual edits that do not fit the line after its text changed: listed, to be restored or discarded. */

import { button } from "../parts/fields.js";
import { fill, make } from "../parts/dom.js";

/** @param {import("../studio/studio.js").Studio} studio @returns {HTMLElement} */
export function mountLost({ store, actions }) {
  const list = make("ul", { class: "lost" });
  const forget = button("Discard them", { id: "lost-forget", onclick: () => actions.letGo() });
  const element = make(
    "section",
    { class: "stack tight", id: "lost", "aria-label": "Edits that do not fit" },
    make("p", { class: "hint" }, "These manual edits do not fit the new text:"),
    list,
    make("div", { class: "row" }, forget),
  );
  store.watch(["take"], () => {
    const lost = store.get("take")?.lost ?? [];
    element.hidden = lost.length === 0;
    fill(list, ...lost.map((text, number) => row(text, () => actions.bringBack(number))));
  });
  return element;
}

/** @param {string} text @param {() => void} bringBack */
function row(text, bringBack) {
  const back = button("Restore", { "aria-label": `Restore: ${text}`, onclick: bringBack });
  return make("li", {}, make("span", {}, text), back);
}
