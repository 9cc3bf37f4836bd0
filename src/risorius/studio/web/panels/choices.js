/** The settings of a performance as controls: which there are, and in which groups, is written here once. */

import { button, check, choice, field, number, slider } from "../parts/fields.js";
import { make, settled } from "../parts/dom.js";

const WAIT = 250; // ms after the last movement of a slider

/**
 * Groups of settings: [title, open, rows]. A row is [key, label, kind, about]; `about` may be a function of the
 * catalogue. Kinds: "choice" (options, empty), "check", "number", "slider", "several" (options).
 */
const GROUPS = [
  [
    "Voice",
    true,
    [
      ["language", "Language", "choice", (c) => ({ options: c.languages, empty: "of the voice" })],
      ["voice", "Voice", "choice", (c) => ({ options: speaking(c), empty: "default" })],
      ["rate", "Words per minute", "number", { low: 80, high: 440, step: 5, placeholder: "voice's own" }],
      ["voice_emotion", "Emotion is heard", "check"],
    ],
  ],
  [
    "Manner",
    true,
    [
      ["profile", "Profile", "choice", (c) => ({ options: described(c.profiles) })],
      ["attitudes", "Attitudes", "several", (c) => ({ options: described(c.attitudes) })],
      ["lively", "Rules, blinks, gaze", "check"],
      ["manner", "Speaks", "choice", (c) => ({ options: c.manners })],
      ["articulation", "Articulation", "slider", { low: 0, high: 2, step: 0.05 }],
    ],
  ],
  [
    "Head",
    false,
    [
      [
        "head",
        "Head",
        "choice",
        (c) => ({ options: c.heads.map((h) => ({ name: h.name, description: h.title })) }),
      ],
      ["age", "Age", "number", { low: 0, high: 100, step: 1, placeholder: "own" }],
      ["hair", "Hair", "choice", (c) => ({ options: c.looks.hair, empty: "own" })],
      [
        "complexion",
        "Complexion",
        "choice",
        (c) => ({ options: complexions(c), empty: "own", numeric: true }),
      ],
      ["dynamics", "Skin", "choice", (c) => ({ options: c.dynamics })],
    ],
  ],
  [
    "Models",
    false,
    [
      ["lips", "Lips", "choice", (c) => ({ options: c.lip_models })],
      ["conflict", "Conflicts", "choice", (c) => ({ options: c.policies })],
      ["contact", "Lips always close", "check"],
      ["onset_function", "Onsets", "choice", (c) => ({ options: c.onset_functions, empty: "by channel" })],
      ["without", "Leave out", "several", (c) => ({ options: c.channels.map(({ name }) => name) })],
      [
        "activation_threshold",
        "Threshold",
        "number",
        { low: 0, high: 1, step: 0.01, placeholder: "by muscle" },
      ],
      ["min_onset", "Least onset, s", "number", { low: 0, high: 10, step: 0.01, placeholder: "by muscle" }],
      ["min_offset", "Least offset, s", "number", { low: 0, high: 10, step: 0.01, placeholder: "by muscle" }],
    ],
  ],
  [
    "Time and chance",
    false,
    [
      ["seed", "Seed", "number", { low: 0, high: 2 ** 31, step: 1, fixed: true }],
      ["fps", "Frames per second", "rate"],
      ["lead", "Silence before, s", "number", { low: 0, high: 60, step: 0.1, fixed: true }],
      ["tail", "Silence after, s", "number", { low: 0, high: 60, step: 0.1, fixed: true }],
    ],
  ],
];

const RATES = ["24", "25", "24000/1001", "30", "30000/1001", "50", "60"];

const MAKERS = {
  choice: makeChoice,
  check: makeCheck,
  number: makeNumber,
  slider: makeSlider,
  several: makeSeveral,
  rate: makeRate,
};

/**
 * Put all settings into a form; a change is performed at once.
 * @param {HTMLElement} form @param {object} studio
 */
export function mountChoices(form, { store, actions }) {
  const slow = settled((parts) => actions.choose({ choices: parts }), WAIT);
  const set = (key, value) => {
    const parts = { [key]: value, ...(key === "language" ? { voice: null } : {}) };
    store.set({ choices: { ...store.get("choices"), ...parts } });
    slow(parts);
  };
  const rows = choiceRows(form, store.get("catalogue"), store.get("choices"), set);
  form.append(newSeed(() => set("seed", (store.get("choices").seed + 1) % 2 ** 31)));
  store.watch(["choices"], () => rows.show(store.get("choices")));
}

/**
 * Put settings into a form.
 * @param {HTMLElement} form @param {object} catalogue @param {object} choices those that hold
 * @param {(key: string, value: any) => void} set
 * @param {string[] | null} only keys that are wanted, all where null
 * @returns {{show: (choices: object) => void, row: (key: string) => HTMLElement | undefined}}
 */
export function choiceRows(form, catalogue, choices, set, only = null) {
  const controls = new Map();
  for (const [title, open, rows] of GROUPS) {
    const wanted = rows.filter(([key]) => only === null || only.includes(key));
    const fields = wanted.map(([key, label, kind, about = {}]) => {
      const given = typeof about === "function" ? about(catalogue) : about;
      const control = MAKERS[kind](label, given, choices[key], (value) => set(key, value), catalogue);
      const element = kind === "check" ? control : field(label, control, { hint: given.hint });
      element.dataset.choice = key;
      controls.set(key, { control, element });
      return element;
    });
    if (fields.length === 0) continue;
    if (only) continue;
    form.append(
      make("details", { open }, make("summary", {}, title), make("div", { class: "stack" }, ...fields)),
    );
  }
  if (only) form.append(...only.map((key) => controls.get(key).element));
  const show = (now) => {
    for (const [key, { control }] of controls) control.show(now[key]);
    const voice = controls.get("voice")?.control;
    if (voice) showVoices(voice, catalogue, now);
  };
  show(choices);
  return { show, row: (key) => controls.get(key)?.element };
}

function makeChoice(label, { options, empty, numeric = false }, value, set) {
  const change = (name) => set(name !== null && numeric ? Number(name) : name);
  return choice(options, { value, empty, change });
}

function makeCheck(label, about, value, set) {
  return check(label, { value, change: set, ...about });
}

function makeNumber(label, { fixed = false, ...about }, value, set) {
  return number({ ...about, optional: !fixed, value, change: set });
}

function makeSlider(label, about, value, set) {
  return slider({ label, ...about, value, input: set });
}

function makeRate(label, about, value, set) {
  return choice(
    RATES.map((name) => ({ name, title: name })),
    { value, change: set },
  );
}

/** Some of several, as buttons that stay pressed. */
function makeSeveral(label, { options }, value, set) {
  let chosen = [...value];
  const buttons = options.map((option) => {
    const { name, description } = typeof option === "string" ? { name: option } : option;
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
  element.show = (now) => {
    chosen = [...now];
    for (const it of buttons) it.setAttribute("aria-pressed", String(chosen.includes(it.dataset.name)));
  };
  element.show(value);
  return element;
}

function newSeed(act) {
  return button("Another seed", { title: "The same with other random blinks and glances", onclick: act });
}

function described(items) {
  return items.map(({ name, description }) => ({ name, description }));
}

function complexions(catalogue) {
  return Object.entries(catalogue.looks.complexions).map(([title, value]) => ({
    name: String(value),
    title,
  }));
}

/** Voices that speak; those named +… only change the timbre of another. */
function speaking(catalogue) {
  return catalogue.voices.filter(({ name }) => !name.startsWith("+"));
}

/** Show the voices of the language that is chosen, and the one that is chosen in any case. */
function showVoices(list, catalogue, { voice, language }) {
  const own = speaking(catalogue).filter(
    (v) => language === null || v.language.startsWith(language.split("-")[0]),
  );
  for (const option of list.options) {
    const name = option.value;
    option.hidden = name !== "" && name !== voice && !own.some((v) => v.name === name);
  }
  if (voice !== null && list.value !== voice) {
    list.append(make("option", { value: voice }, voice));
    list.value = voice;
  }
}
