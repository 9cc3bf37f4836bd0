/** Rules: which fired and where, each to be switched off; and the profile's numbers. */

import { button } from "../parts/fields.js";
import { fill, make, spoken } from "../parts/dom.js";
import { mountProfile } from "./profile.js";

/** @param {HTMLElement} element @param {object} studio */
export function mountRules(element, studio) {
  const { store, actions } = studio;
  const list = make("div", { class: "stack", id: "rules" });
  const search = make("input", { type: "search", placeholder: "Find …", "aria-label": "Find a rule", oninput: filter });
  const fired = make("input", { type: "checkbox", checked: true, onchange: filter });
  const only = make("label", { class: "check" }, fired, "Only those that fired, or are off");
  const profile = make("div", {});
  element.append(search, only, list, profile);
  let asked = 0;
  let found = new Map();
  let profiled = false;
  store.watch(["catalogue", "take", "tab"], async () => {
    if (store.get("tab") !== "rules" || !store.get("catalogue")) return;
    if (!profiled) mountProfile(profile, studio);
    profiled = true;
    const take = store.get("take");
    if (take && take.take !== asked) {
      asked = take.take;
      const answer = await actions.ask("rules_fired", { take: take.take });
      if (asked !== take.take) return;
      found = new Map((answer?.rules ?? []).map((rule) => [rule.rule, rule]));
    }
    show();
  });

  function show() {
    const groups = new Map();
    for (const rule of known()) {
      const group = rule.id.split(".")[0];
      if (!groups.has(group)) groups.set(group, []);
      groups.get(group).push(rowOf(rule));
    }
    fill(list, ...[...groups].map(([title, rows]) => make("section", { class: "stack tight" }, make("h3", {}, spoken(title)), ...rows)));
    filter();
  }

  /** The rules of the catalogue, and what else made movements, in order of their ids. */
  function known() {
    const rules = new Map(store.get("catalogue").rules.map((rule) => [rule.id, rule]));
    for (const [id, { comment }] of found) if (!rules.has(id)) rules.set(id, { id, comment });
    return [...rules.values()].sort((a, b) => (a.id < b.id ? -1 : 1));
  }

  function rowOf({ id, comment }) {
    const off = store.get("choices").rules_off;
    const times = found.get(id)?.times ?? [];
    const blocks = found.get(id)?.blocks ?? [];
    const box = make("input", { type: "checkbox", role: "switch", checked: !off.includes(id), onchange: () => turn(id, box.checked) });
    const label = make("label", { class: "check" }, box, make("span", { class: "name" }, id.split(".").slice(1).join(" ") || id));
    const places = times.map((time, k) =>
      button(time.toFixed(2), { class: "chip", "aria-label": `Go to ${time.toFixed(2)} seconds`, onclick: () => go(time, blocks[k]) }),
    );
    const find = `${id} ${comment}`.toLowerCase();
    return make(
      "div",
      { class: "rule", "data-find": find, "data-idle": times.length === 0 && !off.includes(id), "data-rule": id },
      label,
      make("p", { class: "hint" }, comment),
      make("div", { class: "row tight" }, ...places),
    );
  }

  function turn(id, on) {
    const off = store.get("choices").rules_off.filter((other) => other !== id);
    actions.choose({ choices: { rules_off: on ? off : [...off, id] } });
  }

  function go(time, movement) {
    studio.clock.pause();
    studio.clock.seek(time);
    actions.select({ time, movement });
  }

  function filter() {
    const wanted = search.value.trim().toLowerCase();
    for (const row of list.querySelectorAll(".rule")) {
      row.hidden = !row.dataset.find.includes(wanted) || (fired.checked && row.dataset.idle !== undefined);
    }
    for (const group of list.children) group.hidden = !group.querySelector(".rule:not([hidden])");
  }
}
