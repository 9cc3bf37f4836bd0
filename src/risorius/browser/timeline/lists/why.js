import { clockTime } from "../paint/paint_head.js";
import { foundIn, h, spoken } from "../dom.js";
import { KeyTable } from "./keytable.js";
import { Targets } from "./targets.js";
import { timesOf } from "../model/times.js";
/** @import {Block, NamedReason, Parameters, Selection} from "../../types.js" */
/** @import {ContributionView, Reason} from "../../wire.js" */

/**
 * Explains the selection in words: a movement and its cause, a parameter's value with its winner and losers.
 */

const TIMES = ["Start", "Apex from", "Apex to", "End"];

export class Why {
  #box = h("div", { class: "tl-why" });
  #controller;
  /** @type {object | null} */
  #asked = null;
  /** @type {HTMLInputElement[]} */
  #times = [];
  #keys;
  #targets;
  /** @type {NamedReason[]} */
  #instead = []; // reasons of the movements that win over the selected one

  /** @param {HTMLElement} parent @param {import("../controller.js").TimelineController} controller */
  constructor(parent, controller) {
    this.#controller = controller;
    this.#keys = new KeyTable(controller);
    this.#targets = new Targets(controller);
    parent.replaceChildren(this.#box);
  }

  /** Explain the store's selection in the current take. @param {Selection} selection */
  async show({ time, parameter, movement }) {
    const { model } = this.#controller.scene;
    const asked = (this.#asked = {});
    const block = model?.blocks.get(movement ?? "") ?? null;
    if (!model || time === null || (!parameter && !block)) {
      this.#box.replaceChildren(...advice(Boolean(model)));
      return;
    }
    const at = Math.min(time, model.duration);
    const answer = await this.#controller.actions.ask("explain", { take: model.take.take, time: at, parameter });
    if (asked !== this.#asked || answer === null) return;
    const all = /** @type {Reason[]} */ (answer.reasons);
    const its = all.filter((reason) => parameter || concerns(reason, block));
    const reasons = together(its);
    this.#instead = together(all.filter((reason) => !parameter && block && !its.includes(reason) && aims(block, reason)));
    const focus = this.#box.contains(document.activeElement) ? (document.activeElement?.id ?? "") : "";
    this.#box.replaceChildren(...this.#parts(block, parameter, at, reasons));
    if (focus) foundIn(this.#box, `#${CSS.escape(focus)}`)?.focus();
  }

  /** Show the current times of the selected block. */
  refresh() {
    const { block } = this.#controller;
    if (!block) return;
    const times = timesOf(this.#controller.edits.shown(block) ?? block);
    this.#times.forEach((input, k) => {
      if (input !== document.activeElement) input.value = times[k].toFixed(3);
    });
  }

  /** @param {Block | null} block @param {string | null} parameter @param {number} time @param {NamedReason[]} reasons */
  #parts(block, parameter, time, reasons) {
    this.#times = [];
    const when = h("p", { class: "hint" }, `At ${clockTime(time)} s`);
    if (parameter) {
      const told = reasons.map((one) => this.#reason(one));
      const rest = reasons.length ? [] : [h("p", {}, "At rest: nothing moves it.")];
      return [h("h2", {}, spoken(parameter)), when, ...rest, ...told, this.#keys.element(parameter, time)];
    }
    if (block === null) return [];
    const told = reasons.length ? reasons.map((one) => this.#reason(one)) : this.#idle(block);
    return [...this.#head(block), when, ...told, ...(block.free ? this.#shape(block) : this.#shut(block))];
  }

  /** Explain why a movement is not visible, with the movements that act on its targets instead. @param {Block} block */
  #idle(block) {
    const { parameters } = this.#controller.scene.model;
    const targets = Object.entries(block.targets);
    const home = targets.length > 0 && targets.every(([name, value]) => value === parameters.get(name)?.neutral);
    const before = home ? this.#before(block) : null;
    const link = before && h("button", { class: "tl-what", onclick: () => this.#go(before.id) }, before.label || before.layer);
    const why = home
      ? h("p", {}, `It ${link ? "brings" : "keeps"} ${block.channel} ${link ? "back to" : "at"} rest`, ...(link ? [", after ", link] : []), ".")
      : h("p", {}, "At this time it has no visible effect.");
    const { silent } = this.#controller.scene.model;
    if (silent.has(block.channel)) return [h("p", {}, `It has no effect: the lane ${block.channel} is muted.`)];
    const others = this.#instead.map((one) => this.#reason(one));
    return others.length ? [why, h("p", { class: "hint" }, "Movements that act on the same muscles at that time:"), ...others] : [why];
  }

  /** Return the previous movement in its lane that has a target, or null. @param {Block} block */
  #before({ channel, start }) {
    const { model } = this.#controller.scene;
    /** @param {{targets: Record<string, number>}} block */
    const moves = ({ targets }) =>
      Object.entries(targets).some(([name, value]) => value !== model.parameters.get(name)?.neutral);
    const lane = model.take.blocks.filter((block) => block.channel === channel && block.start < start && moves(block));
    return lane.at(-1) ?? null;
  }

  /** Describe a movement and its cause. @param {Block} block */
  #head(block) {
    const title = h("h2", {}, block.label || "silence");
    const lane = h("p", { class: "tl-part", style: colourOf(block.channel) }, `${block.channel}, priority ${block.priority}`);
    const cause = h("p", {}, block.cause ? `Because of ${block.cause}` : "The cause is unknown.");
    return [title, lane, cause];
  }

  /** Explain why a movement cannot be changed. @param {Block} block */
  #shut({ editable, channel }) {
    return editable ? [h("p", { class: "hint" }, `The lane ${channel} is locked.`)] : [];
  }

  /** Return its times and targets as number fields. @param {Block} block */
  #shape(block) {
    this.#times = TIMES.map((title, k) => this.#time(title, k));
    this.refresh();
    const labels = TIMES.map((title, k) => h("label", { for: this.#times[k].id }, `${title}, s`, this.#times[k]));
    return [h("div", { class: "tl-times" }, ...labels), this.#targets.element(block)];
  }

  /** @param {string} title @param {number} k */
  #time(title, k) {
    const change = () => input.value && this.#controller.setTime(k, Number(input.value));
    const input = h("input", { id: `tl-time-${k}`, type: "number", min: "0", step: "0.01", onchange: change });
    return input;
  }

  /** @param {NamedReason} reason */
  #reason({ names, value, unit, winner, losers, notes }) {
    const amount = `${value.toFixed(unit ? 1 : 2)}${unit ? ` ${unit}` : ""}`;
    const lines = [...(winner ? [this.#part(winner, false)] : []), ...losers.map((part) => this.#part(part, true))];
    return h("section", {},
      h("h3", {}, h("span", {}, names), h("span", { class: "tl-amount" }, amount)),
      winner ? null : h("p", {}, "At rest."),
      h("ul", {}, ...lines, ...notes.map((note) => h("li", { class: "tl-part" }, note))),
    ); // prettier-ignore
  }

  /** @param {ContributionView} part @param {boolean} lost */
  #part({ channel, what, rule, place, asked, given, reason, movement }, lost) {
    const { blocks } = this.#controller.scene.model;
    const named = blocks.has(movement)
      ? h("button", { class: "tl-what", title: "Go to this movement", onclick: () => this.#go(movement) }, what)
      : h("span", { class: "tl-what" }, what);
    const less = Math.abs(given - asked) > 5e-4;
    const amount = less ? `gets ${given.toFixed(2)} of the ${asked.toFixed(2)} it asks for` : `gives ${asked.toFixed(2)}`;
    const from = [rule, place].filter(Boolean).join(", ");
    const told = readable(reason, this.#controller.scene.model.parameters);
    const why = told ? `${lost ? "not shown: " : ""}${told}` : "";
    const struck = lost && !reason.startsWith("add");
    return h("li", { class: struck ? "tl-part lost" : "tl-part", style: colourOf(channel) },
      `${channel}: `, named, ` ${amount}`, from ? h("span", { class: "hint" }, ` (${from})`) : null,
      why ? h("p", {}, struck ? why : told) : null); // prettier-ignore
  }

  /** @param {string} movement */
  #go(movement) {
    const block = this.#controller.scene.model.blocks.get(movement);
    if (!block) return;
    this.#controller.choose(block);
    this.#controller.reveal(block);
  }
}

/** @param {string} channel */
function colourOf(channel) {
  return { "--colour": `var(--tl-channel-${channel})` };
}

/** Return a sentence with readable names of parameters. @param {string} sentence @param {Parameters} parameters */
function readable(sentence, parameters) {
  return sentence.replace(/[a-z]+(?:_[a-z]+)*(?:\.(?:left|right))?/g, (name) => (parameters.has(name) ? spoken(name) : name));
}

/** Whether a block affects a parameter. @param {Reason} reason @param {Block | null} block */
function concerns({ winner, losers }, block) {
  return block !== null && [winner, ...losers].some((part) => part?.movement === block.id);
}

/** Whether a block aims at a parameter, or at both sides of it. @param {Block} block @param {Reason} reason */
function aims({ targets }, { parameter }) {
  return parameter in targets || parameter.split(".")[0] in targets;
}

/**
 * Merge the reasons of the two sides that are the same.
 * @param {Reason[]} reasons @returns {NamedReason[]}
 */
function together(reasons) {
  const found = new Map();
  for (const reason of reasons) {
    const [base, side = ""] = reason.parameter.split(".");
    const same = JSON.stringify([base, reason.value, reason.winner, reason.losers, reason.notes]);
    if (found.has(same)) found.get(same).names = spoken(base);
    else found.set(same, { ...reason, names: side ? `${spoken(base)}, ${side}` : spoken(base) });
  }
  return [...found.values()];
}

/** @param {boolean} there */
function advice(there) {
  if (!there) return [h("p", { class: "hint" }, "Perform a line to see why its face moves.")];
  const lines = [
    "Click a movement or a graph to see why.",
    "Drag a movement to move it, its corners to stretch it.",
    "Double-click a lane to add a movement, a graph to set a key.",
  ];
  return [h("h2", {}, "Why?"), ...lines.map((line) => h("p", { class: "hint" }, line))];
}
