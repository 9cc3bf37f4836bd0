/** The numbers of the speaker's profile: edits are performed at once, and can be exported as a profile file. */

import { button, field, number } from "../parts/fields.js";
import { fill, make, settled, spoken } from "../parts/dom.js";
import { downloadText } from "../parts/download.js";
/** @import {NumberRow} from "../wire.js" */

const WAIT = 400;

/** @param {HTMLElement} element @param {import("../studio/studio.js").Studio} studio */
export function mountProfile(element, { store, actions }) {
  /** @type {Record<string, number>} */
  let numbers = {}; // changed ones by key
  /** @type {string | null | undefined} its name */
  let base = null;
  const rows = make("div", { class: "stack" });
  const name = make("input", { type: "text", id: "profile-name", maxlength: 60, value: "mine" });
  const write = button("Export profile", { id: "export-profile", onclick: exportIt });
  const reset = button("Reset", {
    onclick: () => {
      numbers = {};
      apply();
      show();
    },
  });
  const summary = make("summary", {}, "Numbers of the profile");
  const buttons = make("div", { class: "row" }, write, reset);
  element.append(make("details", {}, summary, rows, field("Name", name), buttons));
  const apply = settled(async () => {
    if (Object.keys(numbers).length === 0) {
      actions.choose({ choices: { profile_text: null } });
      return;
    }
    const file = await text();
    if (file) actions.choose({ choices: { profile_text: file.text } });
  }, WAIT);
  store.watch(["choices"], () => {
    if (store.get("choices").profile === base) return;
    base = store.get("choices").profile;
    numbers = {};
    show();
  });

  function text() {
    return actions.ask("profile_text", { base, name: name.value.trim() || "mine", numbers });
  }

  async function exportIt() {
    const file = await text();
    if (file) downloadText(file.text, `${file.name}.toml`);
  }

  function show() {
    const profile = store.get("catalogue").profiles.find((found) => found.name === base);
    /** @type {Map<string, HTMLElement[]>} */
    const groups = new Map();
    for (const row of Object.values(profile?.numbers ?? {})) {
      const group = row.key.split(".")[0];
      groups.set(group, [...(groups.get(group) ?? []), rowOf(row)]);
    }
    fill(
      rows,
      ...[...groups].map(([title, fields]) =>
        make(
          "details",
          {},
          make("summary", {}, spoken(title)),
          make("div", { class: "stack tight" }, ...fields),
        ),
      ),
    );
    summary.textContent = `Numbers of the profile “${base}”`;
  }

  /** @param {NumberRow} row */
  function rowOf({ key, value, low, high }) {
    /** @param {number} now */
    const change = (now) => {
      numbers = { ...numbers, [key]: now };
      if (now === value) delete numbers[key];
      box.toggleAttribute("data-other", now !== value);
      apply();
    };
    const box = number({ value: numbers[key] ?? value, low, high, change });
    return field(spoken(key.split(".").slice(1).join(" ")), box, { hint: key });
  }
}
