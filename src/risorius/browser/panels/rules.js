/** Rules: list those that fired and their places, switch each on or off; and the profile's numbers. */

import { button } from "../parts/fields.js";
import { fill, make, showFound, spoken } from "../parts/dom.js";
import { mountProfile } from "./profile.js";
/** @import {Studio} from "../studio/studio.js" */
/** @import {FiredRule} from "../wire.js" */

/** @typedef {{id: string, comment: string}} Known a rule, or another cause of movements */

/** @param {HTMLElement} element @param {import("../studio/studio.js").Studio} studio */
export function mountRules(element, studio) {
  new Rules(element, studio);
}

const PLACES = 9; // places of a rule that are shown at first

class Rules {
  #studio;
  #store;
  #list = make("div", { class: "stack", id: "rules" });
  #search;
  #onlyFired;
  #asked = 0;
  /** @type {Map<string, FiredRule>} */
  #found = new Map();

  /** @param {HTMLElement} element @param {Studio} studio */
  constructor(element, studio) {
    this.#studio = studio;
    this.#store = studio.store;
    const filter = () => this.#filter();
    this.#search = make("input", {
      type: "search",
      placeholder: "Find …",
      "aria-label": "Find a rule",
      oninput: filter,
    });
    this.#onlyFired = make("input", { type: "checkbox", checked: true, onchange: filter });
    const only = make("label", { class: "check" }, this.#onlyFired, "Only rules that fired or are off");
    const profile = make("div", {});
    element.append(this.#search, only, this.#list, profile);
    this.#store.watch(["catalogue", "take", "tab"], () => this.#update(profile));
  }

  /** While the panel is hidden, nothing is requested from the server. @param {HTMLElement} profile */
  async #update(profile) {
    const take = this.#store.get("take");
    if (this.#store.get("tab") !== "rules" || !this.#store.get("catalogue")) return;
    if (profile.childElementCount === 0) mountProfile(profile, this.#studio);
    if (take && take.take !== this.#asked) {
      this.#asked = take.take;
      const answer = await this.#studio.actions.ask("rules_fired", { take: take.take });
      if (this.#asked !== take.take) return;
      this.#found = new Map(/** @type {FiredRule[]} */ (answer?.rules ?? []).map((rule) => [rule.rule, rule]));
    }
    this.#show();
  }

  #show() {
    const groups = Map.groupBy(this.#known(), ({ id }) => id.split(".")[0]);
    const sections = [...groups].map(([title, rules]) =>
      make(
        "section",
        { class: "stack tight" },
        make("h2", {}, spoken(title)),
        ...rules.map((rule) => this.#row(rule)),
      ),
    );
    fill(this.#list, ...sections);
    this.#filter();
  }

  /** Return the rules of the catalogue and other causes of movements, sorted by id. */
  #known() {
    /** @type {Map<string, Known>} */
    const rules = new Map(this.#store.get("catalogue").rules.map((rule) => [rule.id, rule]));
    for (const [id, { comment }] of this.#found) if (!rules.has(id)) rules.set(id, { id, comment });
    return [...rules.values()].sort((a, b) => (a.id < b.id ? -1 : 1));
  }

  /** @param {Known} rule */
  #row({ id, comment }) {
    const on = !this.#off.includes(id);
    const { times = [], blocks = [] } = this.#found.get(id) ?? {};
    const box = make("input", {
      type: "checkbox",
      role: "switch",
      checked: on,
      onchange: () => this.#turn(id, box.checked),
    });
    const name = make("span", { class: "name" }, id.split(".").slice(1).join(" ") || id);
    const places = times.map((time, k) => this.#place(time, blocks[k]));
    const about = {
      "data-rule": id,
      "data-find": `${id} ${comment}`.toLowerCase(),
      "data-idle": on && times.length === 0,
    };
    const [label, chips] = [
      make("label", { class: "check" }, box, name),
      folded(places),
    ];
    return make("div", { class: "rule", ...about }, label, chips, make("p", { class: "hint" }, comment));
  }

  /** Rules that are switched off. */
  get #off() {
    return this.#store.get("choices").rules_off ?? [];
  }

  /** Return a button that goes to a place where a rule fired. @param {number} time @param {string} movement */
  #place(time, movement) {
    const { clock, actions } = this.#studio;
    const go = () => {
      clock.pause();
      clock.seek(time);
      actions.select({ time, movement });
    };
    const text = time.toFixed(2);
    return button(text, { class: "chip", "aria-label": `Go to ${text} seconds`, onclick: go });
  }

  /** @param {string} id @param {boolean} on */
  #turn(id, on) {
    const off = this.#off.filter((other) => other !== id);
    this.#studio.actions.choose({ choices: { rules_off: on ? off : [...off, id] } });
  }

  #filter() {
    const wanted = this.#search.value.trim().toLowerCase();
    showFound(this.#list, ".rule", ({ dataset }) => {
      const idle = this.#onlyFired.checked && dataset.idle !== undefined;
      return !idle && (dataset.find ?? "").includes(wanted);
    });
  }
}

/** Return a row of buttons: the first few, and one that shows the others. @param {HTMLElement[]} places */
function folded(places) {
  const row = make("div", { class: "row tight" }, ...places.slice(0, PLACES));
  const rest = places.slice(PLACES);
  if (rest.length === 0) return row;
  const unfold = () => {
    more.replaceWith(...rest);
    rest[0].focus();
  };
  const label = `Show ${rest.length} more times`;
  const more = button(`${rest.length} more`, { class: "chip", "aria-label": label, onclick: unfold });
  row.append(more);
  return row;
}
