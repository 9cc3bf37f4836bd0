/** Changes by hand that did not fit the line when its text changed: named, to be brought back or forgotten. */

import { button } from "../parts/fields.js";
import { fill, make } from "../parts/dom.js";

/** @param {import("../studio/studio.js").Studio} studio @returns {HTMLElement} */
export function mountLost({ store, actions }) {
  const list = make("ul", { class: "lost" });
  const forget = button("Forget them", { id: "lost-forget", onclick: () => actions.letGo() });
  const element = make(
    "section",
    { class: "stack tight", id: "lost", "aria-label": "Changes that did not fit" },
    make("p", { class: "hint" }, "These changes by hand did not fit the new text:"),
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
  const back = button("Bring back", { "aria-label": `Bring back: ${text}`, onclick: bringBack });
  return make("li", {}, make("span", {}, text), back);
}
