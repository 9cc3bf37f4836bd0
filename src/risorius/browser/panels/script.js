/** The text of the line, with the parts that have an emotion marked. */

import { characterAt, movedSpans, unitAt } from "../parts/text.js";
import { fill, make } from "../parts/dom.js";
import { hueOf } from "./hues.js";

/**
 * @param {import("../studio/studio.js").Studio} studio
 * @returns {{element: HTMLElement, selected: () => {first: number, last: number} | null,
 *            onselect: (call: () => void) => void}} `selected` in characters of the text
 */
export function mountScript({ store }) {
  const marks = make("div", { class: "marks", "aria-hidden": "true" });
  const text = make("textarea", { id: "script", rows: 3, spellcheck: "true", placeholder: "Text to say …" });
  const label = make("label", { for: "script", class: "label" }, "Line");
  const paper = make("div", { class: "paper" }, marks, text);
  /** @type {(() => void)[]} */
  const calls = [];
  text.addEventListener("input", () => typed(text.value));
  text.addEventListener("scroll", () => {
    marks.scrollTop = text.scrollTop;
  });
  document.addEventListener("selectionchange", () => calls.forEach((call) => call()));
  store.watch(["source"], () => {
    const { script, recording } = store.get("source");
    if (text.value !== script) text.value = script;
    label.textContent = recording === null ? "Line" : "Transcript (empty: the words are recognized)";
  });
  store.watch(["source", "emotions", "catalogue"], () => showMarks());
  store.watch(["catalogue"], () => {
    const limit = store.get("catalogue")?.limits.script;
    if (limit) text.maxLength = limit;
  });
  const element = make("div", { class: "stack tight" }, label, paper);
  return { element, selected, onselect: (call) => calls.push(call) };

  /** @param {string} script */
  function typed(script) {
    const source = store.get("source");
    const emotions = movedSpans(store.get("emotions"), source.script, script);
    store.set({ source: { ...source, script }, emotions });
  }

  function selected() {
    const [from, to] = [text.selectionStart, text.selectionEnd];
    return to > from ? { first: characterAt(text.value, from), last: characterAt(text.value, to) } : null;
  }

  /** The marks are a copy of the text behind it, with the emotional parts coloured. */
  function showMarks() {
    const spans = store.get("emotions").filter((span) => span.first !== null);
    /** @param {number | null} place */
    const units = (place) => unitAt(text.value, place ?? 0);
    const cuts = [
      ...new Set([0, text.value.length, ...spans.flatMap((s) => [units(s.first), units(s.last)])]),
    ];
    cuts.sort((a, b) => a - b);
    const pieces = cuts.slice(1).map((end, k) => {
      const over = spans.findLast((s) => units(s.first) <= cuts[k] && units(s.last) >= end);
      const piece = text.value.slice(cuts[k], end);
      if (!over) return piece;
      const mark = make("mark", {}, piece);
      mark.style.setProperty("--hue", String(hueOf(store.get("catalogue"), over.emotion)));
      return mark;
    });
    fill(marks, ...pieces, "\n");
  }
}
