/** The emotions of a line, over all of it or over part of the text. */

import { button, choice, slider } from "../parts/fields.js";
import { fill, make, settled } from "../parts/dom.js";
import { glyph } from "../parts/glyphs.js";
import { hueOf } from "./hues.js";
/** @import {EmotionSpan} from "../types.js" */

const INTENSITY = 0.7; // of an emotion that is added
const WAIT = 250; // ms after the last movement of a slider

/** @param {import("../studio/studio.js").Studio} studio @param {ReturnType<typeof import("./script.js").mountScript>} script */
export function mountEmotions({ store, actions }, script) {
  /** @type {EmotionSpan[] | null} */
  let shown = null;
  const rows = make("div", { class: "stack tight", id: "emotions" });
  const all = button("Add to whole line", { id: "add-emotion", onclick: () => add({}) });
  const part = button("Add to selection", { id: "add-span", onclick: () => add(script.selected()) });
  script.onselect(() => {
    part.disabled = script.selected() === null;
  });
  part.disabled = true;
  const performed = settled(() => actions.choose({ emotions: store.get("emotions") }), WAIT);
  store.watch(["catalogue", "ownEmotions"], show);
  store.watch(["emotions"], () => shown !== store.get("emotions") && show());
  store.watch(["source"], showPlaces);
  const buttons = make("div", { class: "row" }, all, part);
  return make(
    "fieldset",
    { class: "plain stack tight" },
    make("legend", { class: "label" }, "Emotion"),
    rows,
    buttons,
  );

  /** @param {Partial<EmotionSpan> | null} place */
  function add(place) {
    const names = store.get("catalogue").emotions.map(({ name }) => name);
    const emotion = names.includes("happiness") ? "happiness" : names[0];
    const span = { emotion, intensity: INTENSITY, start: null, end: null, first: null, last: null, ...place };
    set([...store.get("emotions"), span]);
    show();
    rows.lastElementChild?.querySelector("select")?.focus();
  }

  /** @param {EmotionSpan[]} emotions */
  function set(emotions) {
    shown = emotions;
    store.set({ emotions });
    performed();
  }

  /** @param {number} place @param {Partial<EmotionSpan>} parts */
  function change(place, parts) {
    set(store.get("emotions").map((span, k) => (k === place ? { ...span, ...parts } : span)));
    showHue(/** @type {HTMLElement} */ (rows.children[place]), store.get("emotions")[place]);
  }

  function show() {
    if (!store.get("catalogue")) return;
    shown = store.get("emotions");
    fill(rows, ...shown.map((span, place) => row(span, place)));
    showPlaces();
  }

  /** @param {EmotionSpan} span @param {number} place */
  function row(span, place) {
    const own = store.get("ownEmotions").map((name) => ({ name }));
    const names = [
      ...store.get("catalogue").emotions.map(({ name, description }) => ({ name, description })),
      ...own,
    ];
    const name = choice(names, { value: span.emotion, change: (emotion) => change(place, { emotion: emotion ?? "" }) });
    name.setAttribute("aria-label", "Emotion");
    /** @param {number} intensity */
    const input = (intensity) => change(place, { intensity });
    const amount = slider({ label: "Intensity", value: span.intensity, low: 0, high: 1, step: 0.05, input });
    const remove = button(glyph("close"), {
      class: "plain icon",
      "aria-label": "Remove the emotion",
      onclick: () => {
        set(store.get("emotions").filter((_, k) => k !== place));
        show();
      },
    });
    const element = make(
      "div",
      { class: "emotion" },
      name,
      amount,
      remove,
      make("p", { class: "where hint" }),
    );
    showHue(element, span);
    return element;
  }

  /** @param {HTMLElement} element @param {EmotionSpan} span */
  function showHue(element, span) {
    element?.style.setProperty("--hue", String(hueOf(store.get("catalogue"), span.emotion)));
  }

  /** Show with each emotion the words that it covers. */
  function showPlaces() {
    const text = [...store.get("source").script];
    store.get("emotions").forEach((span, place) => {
      const where = rows.children[place]?.querySelector(".where");
      if (where) where.textContent = placeOf(span, text);
    });
  }
}

/** @param {EmotionSpan} span @param {string[]} text */
function placeOf({ first, last, start, end }, text) {
  if (first !== null) return `on “${text.slice(first, last ?? undefined).join("")}”`;
  if (start !== null || end !== null) return `from ${start ?? 0} s${end === null ? "" : ` to ${end} s`}`;
  return "";
}
