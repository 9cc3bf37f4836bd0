import { h, spoken } from "../dom.js";
/** @import {Attributes} from "../../types.js" */
/** @import {Catalogue, ParameterRow} from "../../wire.js" */
/** @typedef {ReturnType<typeof fieldsOf>} Fields of the form */

/** @typedef {[value: string, text: string]} Option */

/**
 * The form that adds a movement: target, amount, times and channel.
 */

/** Kinds of movement, with the default channel of each and its targets in the catalogue. */
/**
 * @type {Record<string, {title: string, channel: string, options: (catalogue: Catalogue) => Option[],
 *   targets: (name: string, amount: number, catalogue: Catalogue) => Record<string, number>,
 *   degrees?: boolean, times?: typeof TIMES}>}
 */
const KINDS = {
  unit: {
    title: "Action unit",
    channel: "signals",
    options: ({ action_units }) => action_units.map(({ name, title }) => [name, `${name} ${title}`]),
    targets: (name, amount) => ({ [name]: amount }),
  },
  muscle: {
    title: "Muscle",
    channel: "signals",
    options: ({ parameters }) => parameters.filter(({ signed, kind }) => !signed && kind !== "distance").map(asOption),
    targets: (name, amount) => ({ [name]: amount }),
  },
  emotion: {
    title: "Emotion",
    channel: "emotion",
    options: ({ emotions }) => emotions.map(({ name }) => [name, name]),
    targets: (name, amount, { emotions }) => scaled(emotions.find((one) => one.name === name)?.targets ?? {}, amount),
  },
  head: {
    title: "Head",
    channel: "head",
    options: ({ parameters }) => parameters.filter(({ kind }) => kind === "head").map(asOption),
    targets: (name, amount) => ({ [name]: amount }),
    degrees: true,
  },
  gaze: {
    title: "Gaze",
    channel: "gaze",
    options: ({ parameters }) => parameters.filter(({ kind, signed }) => kind === "gaze" && signed).map(asOption),
    targets: (name, amount) => ({ [name]: amount }),
    degrees: true,
  },
  blink: {
    title: "Blink",
    channel: "manipulators",
    options: ({ action_units }) => action_units.filter((unit) => unit.number === 45).map(({ name }) => [name, "both eyes"]),
    targets: (name, amount) => ({ [name]: amount }),
    times: { length: 0.26, onset: 0.08, offset: 0.14 },
  },
};
const TIMES = { length: 0.8, onset: 0.15, offset: 0.25 };
const TIMED = /** @type {("length" | "onset" | "offset")[]} */ (["length", "onset", "offset"]);
const AMOUNT = 0.6;
const DEGREES = 10;

/** @param {ParameterRow} parameter @returns {Option} */
function asOption({ name }) {
  return [name, spoken(name)];
}

/** @param {Record<string, number>} targets @param {number} amount */
function scaled(targets, amount) {
  return Object.fromEntries(Object.entries(targets).map(([name, value]) => [name, value * amount]));
}

export class Adder {
  #controller;
  #dialog = h("dialog", { "aria-labelledby": "tl-add-title" });
  /** @type {Fields} */
  #fields;

  /** @param {HTMLElement} parent @param {import("../controller.js").TimelineController} controller */
  constructor(parent, controller) {
    this.#controller = controller;
    this.#fields = fieldsOf([], [], 0, () => {});
    this.#dialog.addEventListener("keydown", (event) => event.stopPropagation());
    parent.append(this.#dialog);
  }

  /** @param {number} time where it starts @param {string | null} channel null: the kind's own */
  open(time, channel = null) {
    const { catalogue } = this.#controller.scene.model;
    const kind = Object.keys(KINDS).find((name) => channel && KINDS[name].channel === channel) ?? "unit";
    this.#dialog.replaceChildren(this.#form(catalogue, time, channel));
    this.#fields.kind.value = kind;
    this.#turn(catalogue, channel);
    this.#dialog.showModal();
    this.#fields.kind.focus();
  }

  /** @param {Catalogue} catalogue @param {number} time @param {string | null} channel */
  #form(catalogue, time, channel) {
    const kinds = Object.entries(KINDS).map(([name, { title }]) => /** @type {Option} */ ([name, title]));
    const channels = catalogue.channels.map(({ name }) => name).filter((name) => name !== "lips" && name !== "manual");
    this.#fields = fieldsOf(kinds, channels.map((name) => [name, name]), time, () => this.#turn(catalogue, channel));
    const { kind, name, amount, channel: lane, start, length, onset, offset } = this.#fields;
    return h("form", { class: "tl-add", method: "dialog", onsubmit: (/** @type {SubmitEvent} */ event) => this.#submit(event, catalogue) },
      h("h2", { id: "tl-add-title" }, "Add a movement"),
      field("Kind", kind), field("Target", name), field("Amount", amount), field("Channel", lane),
      h("div", { class: "tl-times" },
        timed("Start, s", start), timed("Length, s", length), timed("Onset, s", onset), timed("Offset, s", offset)),
      h("div", { class: "row" },
        h("button", { class: "primary", type: "submit" }, "Add"),
        h("button", { type: "button", onclick: () => this.#dialog.close() }, "Cancel")),
    ); // prettier-ignore
  }

  /** Apply the chosen kind. @param {Catalogue} catalogue @param {string | null} channel */
  #turn(catalogue, channel) {
    const { kind, name, amount, channel: lane } = this.#fields;
    const chosen = KINDS[kind.value];
    name.replaceChildren(...chosen.options(catalogue).map(([value, text]) => h("option", { value }, text)));
    amount.value = String(chosen.degrees ? DEGREES : chosen.times ? 1 : AMOUNT);
    amount.setAttribute("aria-description", chosen.degrees ? "degrees" : "0 to 1");
    lane.value = channel ?? chosen.channel;
    const times = chosen.times ?? TIMES;
    for (const what of TIMED) this.#fields[what].value = String(times[what]);
  }

  /** @param {SubmitEvent} event @param {Catalogue} catalogue */
  async #submit(event, catalogue) {
    event.preventDefault();
    const { amount, start, length, onset, offset } = numbersOf(this.#fields);
    const targets = KINDS[this.#fields.kind.value].targets(this.#fields.name.value, amount, catalogue);
    const channel = this.#fields.channel.value;
    const before = new Set(this.#controller.scene.model.blocks.keys());
    const answer = await this.#controller.actions.edit("add", { channel, start, end: start + length, targets, onset, offset });
    if (answer === null) return; // the page says why; the form stays
    this.#dialog.close();
    const added = [...this.#controller.scene.model.blocks.values()].find(({ id }) => !before.has(id));
    if (!added) return;
    this.#controller.choose(added);
    this.#controller.reveal(added);
  }
}

/**
 * The form's fields.
 * @param {Option[]} kinds @param {Option[]} channels @param {number} time where the movement starts
 * @param {() => void} turn called when another kind is chosen
 */
function fieldsOf(kinds, channels, time, turn) {
  return {
    kind: select("kind", kinds, turn),
    name: select("name", []),
    amount: number("amount", AMOUNT, { step: "any" }),
    channel: select("channel", channels),
    start: number("start", Number(time.toFixed(3)), { min: 0, step: "any" }),
    length: number("length", TIMES.length, { min: 0.01, step: "any" }),
    onset: number("onset", TIMES.onset, { min: 0, step: "any" }),
    offset: number("offset", TIMES.offset, { min: 0, step: "any" }),
  };
}

/** Return the values of the number fields. @param {Fields} fields */
function numbersOf({ amount, start, length, onset, offset }) {
  const [far, from, long, rise, fall] = [amount, start, length, onset, offset].map(({ value }) => Number(value));
  return { amount: far, start: from, length: long, onset: rise, offset: fall };
}

/** @param {string} name @param {Option[]} options @param {() => void} [onchange] */
function select(name, options, onchange = () => {}) {
  return h("select", { id: `tl-add-${name}`, onchange }, ...options.map(([value, text]) => h("option", { value }, text)));
}

/** @param {string} name @param {number} value @param {Attributes} given */
function number(name, value, given) {
  const input = h("input", { id: `tl-add-${name}`, type: "number", required: true, ...given });
  input.value = String(value);
  return input;
}

/** @param {string} title @param {HTMLElement} input */
function field(title, input) {
  return h("div", { class: "field" }, h("label", { for: input.id }, title), input);
}

/** @param {string} title @param {HTMLInputElement} input */
function timed(title, input) {
  return h("label", {}, title, input);
}
