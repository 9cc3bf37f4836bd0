/** Dials: a face held by hand, by muscle, action unit or emotion, one side or both; to be kept under a name. */

import { button, check, slider } from "../parts/fields.js";
import { fill, make, perFrame, spoken } from "../parts/dom.js";
import { mountKeeping } from "./keeping.js";
import { emptyDial, unitsOf } from "./dialled.js";

const KINDS = [
  ["muscles", "Muscles"],
  ["units", "Action units"],
  ["emotions", "Emotions"],
];
const SIDES = [
  ["both", "Both sides"],
  ["left", "Left"],
  ["right", "Right"],
];

/** @param {HTMLElement} element @param {object} studio */
export function mountDials(element, studio) {
  const { store } = studio;
  const face = { dial: emptyDial(), side: "both", kind: "muscles", live: true };
  const rows = make("div", { class: "stack" });
  const notes = make("p", { class: "hint", role: "status" });
  const search = make("input", { type: "search", placeholder: "Find …", "aria-label": "Find a dial", oninput: filter });
  const kinds = pressed(KINDS, "Dials by", () => face.kind, (kind) => {
    face.kind = kind;
    show();
  });
  const sides = pressed(SIDES, "Side", () => face.side, (side) => {
    face.side = side;
    show();
  });
  const springs = check("Skin swings", { value: true, change: (live) => { face.live = live; } });
  const reset = button("Reset", { id: "dials-reset", onclick: () => { face.dial = emptyDial(); send(); show(); } });
  const again = button("Back to line", { id: "dials-back", onclick: () => store.set({ dial: null }) });
  const saved = make("div", { class: "row tight", role: "group", "aria-label": "Saved poses" });
  const foot = make("div", { class: "panel-foot" }, mountKeeping(studio, () => face));
  const top = make("div", { class: "row" }, springs, reset, again);
  element.append(kinds.element, sides.element, top, notes, search, saved, rows, foot);
  store.watch(["poses"], () => {
    const poses = Object.entries(store.get("poses"));
    fill(saved, ...poses.map(([name, values]) => button(name, { class: "chip", onclick: () => take(values) })));
  });
  store.watch(["catalogue"], show);
  store.watch(["dial"], () => { again.hidden = store.get("dial") === null || store.get("take") === null; });

  const request = perFrame(() => ask());
  let busy = false;
  let late = false;

  /** One request at a time; what changes meanwhile is sent when its answer is there. */
  async function ask() {
    if (busy) {
      late = true;
      return;
    }
    busy = true;
    try {
      const state = await studio.connection.request("dial", wire());
      notes.textContent = state.notes.join(" · ");
    } catch (error) {
      notes.textContent = error.message;
    }
    busy = false;
    if (!late) return;
    late = false;
    ask();
  }

  function wire() {
    const { head, age } = store.get("choices");
    return { ...face.dial, live: face.live, head, age };
  }

  function take(values) {
    face.dial = { ...emptyDial(), values };
    send();
    show();
  }

  function send() {
    studio.clock.pause();
    store.set({ dial: face.dial });
    request();
  }

  function show() {
    const catalogue = store.get("catalogue");
    if (!catalogue) return;
    kinds.show();
    sides.show();
    sides.element.hidden = face.kind === "emotions";
    fill(rows, ...unitsOf(catalogue, face.kind, face.side).map((group) => groupOf(group)));
    filter();
  }

  function groupOf({ title, dials }) {
    const heading = title ? [make("h3", {}, spoken(title))] : [];
    return make("section", { class: "stack tight" }, ...heading, ...dials.map((dial) => rowOf(dial)));
  }

  function rowOf(dial) {
    const input = (value) => {
      face.dial = dial.set(face.dial, value);
      send();
    };
    const control = slider({ label: dial.label, value: dial.get(face.dial), ...dial.range, input });
    control.addEventListener("dblclick", () => {
      control.show(dial.range.neutral);
      input(dial.range.neutral);
    });
    const label = make("span", { class: "name", title: dial.hint || null }, dial.label);
    return make("div", { class: "dial", "data-find": `${dial.label} ${dial.hint}`.toLowerCase() }, label, control);
  }

  function filter() {
    const wanted = search.value.trim().toLowerCase();
    for (const row of rows.querySelectorAll(".dial")) row.hidden = !row.dataset.find.includes(wanted);
    for (const group of rows.children) group.hidden = !group.querySelector(".dial:not([hidden])");
  }
}

/** Buttons of which one is pressed. */
function pressed(options, label, get, set) {
  const buttons = options.map(([name, title]) => button(title, { "data-name": name, onclick: () => set(name) }));
  const show = () => {
    for (const it of buttons) it.setAttribute("aria-pressed", String(it.dataset.name === get()));
  };
  show();
  return { element: make("div", { class: "segments", role: "group", "aria-label": label }, ...buttons), show };
}
