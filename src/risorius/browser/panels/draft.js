/** The draft (text written but not performed): buttons that show the performed text, and restore the draft. */

import { PARTS, bringBack, isDraft, putAside } from "../studio/drafts.js";
import { button } from "../parts/fields.js";
import { make } from "../parts/dom.js";

/** @param {import("../studio/studio.js").Studio} studio @returns {HTMLElement} */
export function mountDraft({ store }) {
  const hint = make("span", { class: "hint" }, "Not performed yet");
  const drop = button("Show performed text", {
    id: "draft-aside",
    title: "Show the text and settings of the current take",
    onclick: () => putAside(store),
  });
  const back = button("Restore draft", { id: "draft-back", onclick: () => bringBack(store) });
  const element = make("div", { class: "row draft" }, hint, drop, back);
  store.watch([...PARTS, "take", "aside"], () => {
    const draft = store.get("take") !== null && isDraft(store);
    hint.hidden = drop.hidden = !draft;
    back.hidden = draft || store.get("aside") === null;
    element.hidden = drop.hidden && back.hidden;
  });
  return element;
}
