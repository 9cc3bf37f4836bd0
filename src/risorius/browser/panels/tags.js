/** Tags in a text that is read as plain would be spoken: that is said, with what can be done. */

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
  [/^\s*</, "xml"],
];

/** Whether a text has tags. @param {string} text */
export function hasTags(text) {
  return TAG.test(text);
}

/**
 * The text as markup, with its format: tags within words are SSML's.
 * @param {string} text @returns {Pick<Parts["source"], "script" | "format">}
 */
export function asMarkup(text) {
  const format = ROOTS.find(([root]) => root.test(text))?.[1];
  return format ? { script: text, format } : { script: `<speak>${text}</speak>`, format: "ssml" };
}

/** @param {import("../studio/studio.js").Studio} studio @returns {HTMLElement} */
export function mountTags({ store }) {
  const read = button("Read them as markup", { id: "tags-read", onclick: () => write(asMarkup(text())) });
  const remove = button("Take them out", {
    id: "tags-out",
    onclick: () => write({ script: text().replace(TAGS, ""), format: "text" }),
  });
  const element = make(
    "section",
    { class: "stack tight", id: "tags", "aria-label": "Tags" },
    make("p", { class: "hint", role: "status" }, "The tags in this text are spoken as they stand."),
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
