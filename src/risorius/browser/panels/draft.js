/** What is written but not performed: a way back to what is performed, and from there to what was written. */

import { PARTS, bringBack, isDraft, putAside } from "../studio/drafts.js";
import { button } from "../parts/fields.js";
import { make } from "../parts/dom.js";

/** @param {import("../studio/studio.js").Studio} studio @returns {HTMLElement} */
export function mountDraft({ store }) {
  const hint = make("span", { class: "hint" }, "Not performed yet");
  const drop = button("Back to the take", {
    id: "draft-aside",
    title: "Show what the take was performed from",
    onclick: () => putAside(store),
  });
  const back = button("Bring back what was written", { id: "draft-back", onclick: () => bringBack(store) });
  const element = make("div", { class: "row draft" }, hint, drop, back);
  store.watch([...PARTS, "take", "aside"], () => {
    const draft = store.get("take") !== null && isDraft(store);
    hint.hidden = drop.hidden = !draft;
    back.hidden = draft || store.get("aside") === null;
    element.hidden = drop.hidden && back.hidden;
  });
  return element;
}
