/** Two takes side by side and in step: the current one, and the same line with the settings chosen here. */

import { button } from "../parts/fields.js";
import { choiceRows } from "./choices.js";
import { fill, make, settled, spoken } from "../parts/dom.js";
import { takeOf } from "../player/take.js";
/** @import {Take} from "../studio/store.js" */
/** @import {Catalogue, Choices} from "../wire.js" */

const OFFERED = [
  "conflict",
  "lips",
  "contact",
  "without",
  "onset_function",
  "profile",
  "attitudes",
  "lively",
  "blinks",
  "manner",
  "articulation",
  "dynamics",
  "head",
  "age",
];
const MOST_LISTED = 8;
const WAIT = 250;

/** @param {HTMLElement} element @param {import("../studio/studio.js").Studio} studio */
export function mountCompare(element, studio) {
  const { store, actions } = studio;
  /** @type {Record<string, any>} */
  let other = {}; // the second take's settings that differ
  let asked = 0; // number of comparisons started or ended: an answer to an earlier one is dropped
  const form = make("div", { class: "stack" });
  const note = make(
    "p",
    { class: "hint" },
    "The take is on the left. On the right is the same line with these settings:",
  );
  const show = button("Show side by side", { class: "primary", id: "compare", onclick: compare });
  const end = button("Show one head", { id: "compare-end", onclick: finish });
  const table = make("div", { class: "stack tight" });
  element.append(note, form, table, make("div", { class: "panel-foot" }, show, end));
  const again = settled(() => store.get("other") && compare(), WAIT);
  let comparing = false;
  /** @type {ReturnType<typeof choiceRows> | null} */
  let rows = null;
  store.watch(["catalogue"], () => {
    const catalogue = store.get("catalogue");
    if (!catalogue || rows) return;
    rows = choiceRows(form, catalogue, store.get("choices"), set, OFFERED);
    mark();
  });
  store.watch(["choices"], () => {
    rows?.show({ ...store.get("choices"), ...other });
    if (rows) mark();
  });
  store.watch(["take"], () => (store.get("take") === null ? finish() : again()));
  store.watch(["take", "other", "link"], () => {
    show.disabled = store.get("take") === null || store.get("link") !== "up";
    end.hidden = store.get("other") === null && !comparing;
    fill(table, ...differences(store.get("take"), store.get("other"), store.get("catalogue")));
  });

  /** @param {string} key @param {unknown} value */
  function set(key, value) {
    other = { ...other, [key]: value };
    if (JSON.stringify(value) === JSON.stringify(Reflect.get(store.get("choices"), key))) delete other[key];
    mark();
    again();
  }

  function mark() {
    for (const key of OFFERED) rows?.row(key)?.toggleAttribute("data-other", key in other);
  }

  async function compare() {
    const [number, label] = [++asked, labelOf(other)];
    [comparing, end.hidden] = [true, false];
    const choices = { ...store.get("choices"), ...other };
    const answer = await actions.work("compare", { choices }, "Performing the other take …");
    if (number !== asked) return;
    comparing = false;
    if (answer) store.set({ other: { ...takeOf(answer), label }, dial: null });
    else end.hidden = store.get("other") === null;
  }

  /** Show one head, even if the second has not arrived yet. */
  function finish() {
    asked += 1;
    if (comparing) actions.stop();
    [comparing, end.hidden] = [false, true];
    store.set({ other: null });
  }
}

/** Return the settings in which the second take differs, in words. @param {Choices} other */
function labelOf(other) {
  const parts = Object.entries(other).map(
    ([key, value]) => `${spoken(key)}: ${[value ?? "own"].flat().join(", ") || "none"}`,
  );
  return parts.join(" · ") || "the same";
}

/**
 * Return the parameters in which the two takes differ most.
 * @param {Take | null} take @param {Take | null} other @param {Catalogue} catalogue
 */
function differences(take, other, catalogue) {
  if (!take || !other) return [];
  const rows = catalogue.parameters
    .map(({ name, low, high, neutral, unit }) => {
      const [apart, frame] = furthest(take.curves[name], other.curves[name], neutral);
      return { name, apart, time: frame / take.rate, unit, share: apart / Math.min(high - low, 40) };
    })
    .filter(({ share }) => share > 0.005)
    .sort((a, b) => b.share - a.share)
    .slice(0, MOST_LISTED);
  if (rows.length === 0) return [make("p", { class: "hint" }, "The two takes are the same.")];
  const cells = rows.map(({ name, apart, time, unit }) =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, spoken(name)),
      make("td", {}, `${apart.toFixed(unit ? 1 : 2)}${unit && ` ${unit}`}`),
      make("td", {}, `${time.toFixed(2)} s`),
    ),
  );
  const head = make(
    "tr",
    {},
    ...["Largest differences", "by", "at"].map((text) => make("th", { scope: "col" }, text)),
  );
  return [make("table", { class: "differences" }, make("thead", {}, head), make("tbody", {}, ...cells))];
}

/** @param {Float32Array | undefined} a @param {Float32Array | undefined} b @param {number} neutral */
function furthest(a, b, neutral) {
  let [apart, at] = [0, 0];
  const count = Math.max(a?.length ?? 0, b?.length ?? 0);
  for (let k = 0; k < count; k++) {
    const now = Math.abs((a?.[k] ?? neutral) - (b?.[k] ?? neutral));
    if (now > apart) [apart, at] = [now, k];
  }
  return [apart, at];
}
