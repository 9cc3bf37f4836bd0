/** The settings of a performance as controls; the catalogue lists the settings and their groups. */

import { button, check, choice, field, number, slider } from "../parts/fields.js";
import { make, settled } from "../parts/dom.js";
/** @import {Catalogue, ChoiceRow, Choices, SettingRow} from "../wire.js" */
/** @import {Control} from "../types.js" */

/** @typedef {(value: any) => void} Set receives the new value of a setting */

const WAIT = 250; // ms after the last movement of a slider

// Settings whose values are codes; their names are shown, too.
const CODED = ["language", "voice"];
const OPEN = ["Voice", "Manner"]; // groups that are open at first

/** @type {Record<string, (setting: SettingRow, value: any, set: Set) => Control>} by the setting's `control` */
const MAKERS = {
  choice: makeChoice,
  check: makeCheck,
  number: makeNumber,
  slider: makeSlider,
  several: makeSeveral,
  text: makeText,
};

/**
 * Put all settings into a form; a change is performed at once.
 * @param {HTMLElement} form @param {import("../studio/studio.js").Studio} studio
 */
export function mountChoices(form, { store, actions }) {
  const slow = settled((/** @type {Partial<Choices>} */ parts) => actions.choose({ choices: parts }), WAIT);
  /** @param {string} key @param {unknown} value */
  const set = (key, value) => {
    const parts = { [key]: value, ...(key === "language" ? { voice: null } : {}) };
    store.set({ choices: { ...store.get("choices"), ...parts } });
    slow(parts);
  };
  const rows = choiceRows(form, store.get("catalogue"), store.get("choices"), set);
  form.append(newSeed(() => set("seed", ((store.get("choices").seed ?? 0) + 1) % 2 ** 31)));
  store.watch(["choices"], () => rows.show(store.get("choices")));
}

/**
 * Put settings into a form.
 * @param {HTMLElement} form @param {Catalogue} catalogue @param {Choices} choices the current ones
 * @param {(key: string, value: any) => void} set
 * @param {string[] | null} only keys to show; null shows all
 * @returns {{show: (choices: Choices) => void, row: (key: string) => HTMLElement | undefined}}
 */
export function choiceRows(form, catalogue, choices, set, only = null) {
  /** @type {Map<string, ReturnType<typeof settingRow>>} */
  const controls = new Map();
  const settings = catalogue.settings.filter(({ exported }) => !exported);
  for (const title of new Set(settings.map(({ group }) => group))) {
    const wanted = settings.filter(({ group, key }) => group === title && (only === null || only.includes(key)));
    const fields = wanted.map((setting) => {
      const { control, element } = settingRow(setting, Reflect.get(choices, setting.key), (value) => set(setting.key, value));
      controls.set(setting.key, { control, element });
      return element;
    });
    if (only) continue;
    const stack = make("div", { class: "stack" }, ...fields);
    form.append(make("details", { open: OPEN.includes(title) }, make("summary", {}, title), stack));
  }
  if (only) form.append(...only.flatMap((key) => controls.get(key)?.element ?? []));
  /** @param {Choices} now */
  const show = (now) => {
    for (const [key, { control }] of controls) control.show(Reflect.get(now, key));
    const voice = controls.get("voice")?.control;
    if (voice instanceof HTMLSelectElement) showVoices(voice, catalogue, now);
  };
  show(choices);
  return { show, row: (key) => controls.get(key)?.element };
}

/**
 * A setting as a labelled control.
 * @param {import("../wire.js").SettingRow} setting @param {any} value @param {(value: any) => void} set
 * @returns {{control: Control, element: HTMLElement}}
 */
export function settingRow(setting, value, set) {
  const control = MAKERS[setting.control](setting, value, set);
  const element = setting.control === "check" ? control : field(setting.label, control, { hint: setting.help });
  element.dataset.choice = setting.key;
  return { control, element };
}

/** @param {SettingRow} setting @param {any} value @param {Set} set */
function makeChoice({ key, choices, optional, unset }, value, set) {
  const title = CODED.includes(key) ? namedCode : titleOf;
  const options = choices.map((it) => ({ ...it, name: String(it.value), title: title(it) }));
  /** @param {string} name */
  const valueOf = (name) => choices.find((it) => String(it.value) === name)?.value ?? name;
  /** @param {string | null} name */
  const change = (name) => set(name === null ? null : valueOf(name));
  return choice(options, { value, empty: optional ? unset : undefined, change });
}

/** Return the name of a code, with the code: "German (de)". @param {ChoiceRow} choice */
function namedCode({ name, description }) {
  return description ? `${description} (${name})` : name;
}

/** Return the label of a choice: the name of a number; a code or a fraction unchanged. @param {ChoiceRow} choice */
function titleOf({ name, value }) {
  return typeof value === "number" || /^[\d/]+$/.test(name) ? name : undefined;
}

/** @param {SettingRow} setting @param {any} value @param {Set} set */
function makeCheck({ label }, value, set) {
  return check(label, { value, change: set });
}

/** @param {SettingRow} setting @param {any} value @param {Set} set */
function makeNumber({ low, high, step, optional, unset }, value, set) {
  return number({ low, high, step: step ?? "any", optional, placeholder: unset, value, change: set });
}

/** @param {SettingRow} setting @param {any} value @param {Set} set */
function makeSlider({ label, low, high, step }, value, set) {
  return slider({ label, low: low ?? 0, high: high ?? 1, step: step ?? undefined, value, input: set });
}

/** @param {SettingRow} setting @param {any} value @param {Set} set */
function makeText({ optional, unset }, value, set) {
  const change = () => set(box.value.trim() === "" && optional ? null : box.value.trim());
  const box = make("input", { type: "text", placeholder: unset, onchange: change });
  /** @param {string | null} now */
  const show = (now) => {
    box.value = now ?? "";
  };
  show(value);
  return Object.assign(box, { show });
}

/** A choice of any number of items, as buttons that stay pressed. @param {SettingRow} setting @param {any} value @param {Set} set */
function makeSeveral({ label, choices }, value, set) {
  /** @type {string[]} */
  let chosen = [...value];
  const buttons = choices.map(({ name, description }) => {
    return button(name, {
      class: "chip",
      title: description,
      "data-name": name,
      onclick: () => {
        chosen = chosen.includes(name) ? chosen.filter((other) => other !== name) : [...chosen, name];
        set(chosen);
      },
    });
  });
  const element = make("div", { class: "row tight", role: "group", "aria-label": label }, ...buttons);
  /** @param {string[]} now */
  const show = (now) => {
    chosen = [...now];
    for (const it of buttons) it.setAttribute("aria-pressed", String(chosen.includes(it.dataset.name ?? "")));
  };
  show(value);
  return Object.assign(element, { show });
}

/** @param {() => void} act */
function newSeed(act) {
  return button("Another seed", { title: "Perform again with other random blinks and glances", onclick: act });
}

/** Return the voices that speak; those named +… only change the timbre of another. @param {Catalogue} catalogue */
function speaking(catalogue) {
  return catalogue.voices.filter(({ name }) => !name.startsWith("+"));
}

/**
 * Show the voices of the chosen language, and always the chosen voice.
 * @param {HTMLSelectElement} list @param {Catalogue} catalogue @param {Choices} choices
 */
function showVoices(list, catalogue, { voice, language }) {
  const own = speaking(catalogue).filter(
    (v) => !language || v.language.startsWith(language.split("-")[0]),
  );
  for (const option of list.options) {
    const name = option.value;
    option.hidden = name !== "" && name !== voice && !own.some((v) => v.name === name);
  }
  if (voice && list.value !== voice) {
    list.append(make("option", { value: voice }, voice));
    list.value = voice;
  }
}
