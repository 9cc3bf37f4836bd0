/** Dials: set a face by muscle, action unit or emotion, on one side or both, and save it under a name. */

import { button, check, slider } from "../parts/fields.js";
import { fill, make, showFound, spoken } from "../parts/dom.js";
import { segments } from "../parts/segments.js";
import { Dialler } from "./dialler.js";
import { emptyFace, groupsOf } from "./dialled.js";
import { mountKeeping } from "./keeping.js";
/** @import {Studio} from "../studio/studio.js" */
/** @import {DialledFace, Sides} from "../types.js" */
/** @import {Dial} from "./dialled.js" */

/** @typedef {"muscles" | "units" | "emotions"} Kind */

const KINDS = { muscles: "Muscles", units: "Action units", emotions: "Emotions" };
const SIDES = { both: "Both sides", left: "Left", right: "Right" };

/** @param {HTMLElement} element @param {import("../studio/studio.js").Studio} studio */
export function mountDials(element, studio) {
  new Dials(element, studio);
}

class Dials {
  #store;
  #dialler;
  #face = emptyFace();
  /** @type {Kind} */
  #kind = "muscles";
  /** @type {Sides} */
  #side = "both";
  #live = true;
  #rows = make("div", { class: "stack" });
  #notes = make("p", { class: "hint", role: "status" });
  #saved = make("div", { class: "row tight", role: "group", "aria-label": "Saved poses" });
  #search;
  #sides;

  /** @param {HTMLElement} element @param {Studio} studio */
  constructor(element, studio) {
    this.#store = studio.store;
    this.#dialler = new Dialler(studio, (line) => {
      this.#notes.textContent = line;
    });
    const filter = () => this.#filter();
    this.#search = make("input", {
      type: "search",
      placeholder: "Find …",
      "aria-label": "Find a dial",
      oninput: filter,
    });
    this.#sides = segments(SIDES, "Side", this.#side, (side) => this.#choose(this.#kind, /** @type {Sides} */ (side)));
    const kinds = segments(KINDS, "Dials by", this.#kind, (kind) => this.#choose(/** @type {Kind} */ (kind), this.#side));
    const foot = make(
      "div",
      { class: "panel-foot" },
      mountKeeping(studio, () => this.#face),
    );
    element.append(
      kinds,
      this.#sides,
      this.#buttons(),
      this.#notes,
      this.#search,
      this.#saved,
      this.#rows,
      foot,
    );
    this.#store.watch(["catalogue"], () => this.#show());
    this.#store.watch(["poses"], () => this.#showPoses());
  }

  #buttons() {
    /** @param {boolean} live */
    const change = (live) => {
      this.#live = live;
    };
    const springs = check("Skin swings", { value: true, change });
    const reset = button("Reset", { id: "dials-reset", onclick: () => this.#take(emptyFace()) });
    const back = button("Back to line", { id: "dials-back", onclick: () => this.#store.set({ dial: null }) });
    this.#store.watch(["dial", "take"], () => {
      back.hidden = this.#store.get("dial") === null || this.#store.get("take") === null;
    });
    return make("div", { class: "row" }, springs, reset, back);
  }

  /** @param {Kind} kind @param {Sides} side */
  #choose(kind, side) {
    [this.#kind, this.#side] = [kind, side];
    this.#show();
  }

  /** Set the dialled face. @param {DialledFace} face */
  #take(face) {
    this.#send(face);
    this.#show();
  }

  /** @param {DialledFace} face */
  #send(face) {
    this.#face = face;
    this.#dialler.show(face, this.#live);
  }

  #show() {
    const catalogue = this.#store.get("catalogue");
    if (!catalogue) return;
    this.#sides.hidden = this.#kind === "emotions";
    fill(this.#rows, ...groupsOf(catalogue, this.#kind, this.#side).map((group) => this.#group(group)));
    this.#filter();
  }

  /** @param {{title: string, dials: Dial[]}} group */
  #group({ title, dials }) {
    const heading = title !== "" && make("h2", {}, spoken(title));
    return make("section", { class: "stack tight" }, heading, ...dials.map((dial) => this.#row(dial)));
  }

  /** A dial with its name; a double click resets it. @param {Dial} dial */
  #row(dial) {
    /** @param {number} value */
    const input = (value) => this.#send(dial.set(this.#face, value));
    const control = slider({ label: dial.label, value: dial.get(this.#face), ...dial.range, input });
    control.addEventListener("dblclick", () => {
      control.show(dial.range.neutral);
      input(dial.range.neutral);
    });
    const name = make("span", { class: "name", title: dial.hint || null }, dial.label);
    return make(
      "div",
      { class: "dial", "data-find": `${dial.label} ${dial.hint}`.toLowerCase() },
      name,
      control,
    );
  }

  #showPoses() {
    const poses = Object.entries(this.#store.get("poses"));
    /** @param {Record<string, number>} values */
    const hold = (values) => this.#take({ ...emptyFace(), values });
    fill(
      this.#saved,
      ...poses.map(([name, values]) => button(name, { class: "chip", onclick: () => hold(values) })),
    );
  }

  #filter() {
    const wanted = this.#search.value.trim().toLowerCase();
    showFound(this.#rows, ".dial", ({ dataset }) => (dataset.find ?? "").includes(wanted));
  }
}
