/** Warn that tags in a plain text would be spoken, and offer to read it as markup or to remove them. */

import { button } from "../parts/fields.js";
import { make } from "../parts/dom.js";
import { movedSpans } from "../parts/text.js";
/** @import {Parts} from "../studio/store.js" */

const TAG = /<\/?[A-Za-z][^<>]*>/;
const TAGS = new RegExp(TAG, "g");
/** @type {[RegExp, Parts["source"]["format"]][]} */
const ROOTS = [
  [/^\s*(<\?xml[^>]*>\s*)?<speak\b/i, "ssml"],
  [/^\s*(<\?xml[^>]*>\s*)?<bml\b/i, "bml"],
  [/^\s*(<\?xml[^>]*>\s*)?(<!DOCTYPE[^>]*>\s*)?<(fml-)?apml\b/i, "apml"],
  [/^\s*</, "xml"],
];

/** Whether a text has tags. @param {string} text */
function hasTags(text) {
  return TAG.test(text);
}

/**
 * Return the text as markup, with its format: tags within words are SSML's.
 * @param {string} text @returns {Pick<Parts["source"], "script" | "format">}
 */
function asMarkup(text) {
  const format = ROOTS.find(([root]) => root.test(text))?.[1];
  return format ? { script: text, format } : { script: `<speak>${text}</speak>`, format: "ssml" };
}

/** @param {import("../studio/studio.js").Studio} studio @returns {HTMLElement} */
export function mountTags({ store }) {
  const read = button("Read as markup", { id: "tags-read", onclick: () => write(asMarkup(text())) });
  const remove = button("Remove the tags", {
    id: "tags-out",
    onclick: () => write({ script: text().replace(TAGS, ""), format: "text" }),
  });
  const element = make(
    "section",
    { class: "stack tight", id: "tags", "aria-label": "Tags" },
    make("p", { class: "hint", role: "status" }, "This plain text contains tags: they would be spoken."),
    make("div", { class: "row" }, read, remove),
  );
  store.watch(["source"], () => {
    const { script, format } = store.get("source");
    element.hidden = format !== "text" || !hasTags(script);
  });
  return element;

  function text() {
    return store.get("source").script;
  }

  /** @param {Pick<Parts["source"], "script" | "format">} parts */
  function write(parts) {
    const source = { ...store.get("source"), ...parts };
    store.set({ source, emotions: movedSpans(store.get("emotions"), text(), source.script) });
  }
}
