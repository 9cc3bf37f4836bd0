import { glyph } from "../../parts/glyphs.js";
import { foundIn, h, spoken } from "../dom.js";
/** @import {BodyRow, GraphRow, LaneRow, Sides} from "../../types.js" */
/** @typedef {{state: "muted" | "solo" | "locked", sign: string | (() => Node), verb: string, title: string}} LaneState */

/**
 * The names of lanes and graphs, to the left of them; a graph can be explained, limited to one side, and removed.
 */

/** @type {LaneState[]} */
const STATES = [
  { state: "muted", sign: "M", verb: "Mute", title: "its movements stay but have no effect" },
  { state: "solo", sign: "S", verb: "Solo", title: "only solo lanes move the face" },
  { state: "locked", sign: () => glyph("lock"), verb: "Lock", title: "its movements cannot be changed" },
];
/** @type {Sides[]} */
const SIDES = ["both", "left", "right"];
const SIGNS = { both: "L R", left: "L", right: "R" };

export class Names {
  #box = h("div", { class: "tl-names" });
  #corner = h("div", { class: "tl-corner" });
  #list = h("div");
  #controller;
  #graphs;

  /** @param {HTMLElement} parent @param {import("../controller.js").TimelineController} controller @param {import("../model/graphs.js").Graphs} graphs */
  constructor(parent, controller, graphs) {
    this.#controller = controller;
    this.#graphs = graphs;
    this.#box.append(this.#corner, this.#list);
    parent.append(this.#box);
  }

  /** @param {number} height */
  setHeight(height) {
    this.#box.style.height = `${height}px`;
  }

  /** @param {string} text */
  setTime(text) {
    this.#corner.textContent = text;
  }

  /** Scroll with the canvas. */
  scroll() {
    const { headHeight, scroll, unit } = this.#controller.scene;
    this.#list.style.transform = `translateY(${(headHeight - scroll) * unit}px)`;
  }

  /** Rebuild the rows' names. */
  show() {
    this.#corner.style.height = `${this.#controller.scene.headHeight * this.#controller.scene.unit}px`;
    const held = /** @type {HTMLElement | null} */ (document.activeElement)?.dataset.name;
    this.#list.replaceChildren(...this.#controller.scene.body.map((row) => this.#name(row)));
    if (held) foundIn(this.#list, `[data-name="${CSS.escape(held)}"]`)?.focus({ preventScroll: true });
    this.scroll();
  }

  /** @param {BodyRow} row */
  #name(row) {
    const { unit } = this.#controller.scene;
    /** @type {Record<string, string>} */
    const style = { top: `${row.y * unit}px`, height: `${row.height * unit}px` };
    if (row.kind === "graph") return h("div", { class: "tl-name", style }, ...this.#graph(row));
    style["--colour"] = `var(--tl-channel-${row.lane.channel})`;
    const { channel } = row.lane;
    const silent = this.#controller.scene.model.silent.has(channel);
    const states = STATES.map((state) => this.#state(channel, state));
    return h("div", { class: silent ? "tl-name tl-silent" : "tl-name", style }, this.#lane(row), ...states);
  }

  /** A lane's name folds it: all movements on one row. @param {LaneRow} row */
  #lane({ lane: { channel, priority, spans, count }, fold }) {
    const title = `${spans.items.length} movements, priority ${priority}; click to ${fold ? "unfold" : "fold"} the lane`;
    const name = `${channel}${fold && count > 1 ? ` (${count})` : ""}`;
    const turn = () => this.#controller.fold(channel);
    return h("button", { class: "tl-lane-name", title, "aria-expanded": String(!fold), "data-name": channel, onclick: turn },
      name); // prettier-ignore
  }

  /** A button that mutes, solos or locks a lane. @param {string} channel @param {LaneState} state */
  #state(channel, { state, sign, verb, title }) {
    const on = this.#controller.scene.model.states[state].includes(channel);
    return h("button", {
      class: "tl-state",
      "aria-pressed": String(on),
      "aria-label": `${verb} ${channel}`,
      title: `${verb} ${channel}: ${title}`,
      "data-name": `${channel} ${state}`,
      onclick: () => this.#controller.turnLane(state, channel),
    }, typeof sign === "string" ? sign : sign()); // prettier-ignore
  }

  /** @param {GraphRow} row */
  #graph({ base, names }) {
    const parameter = this.#controller.scene.model.parameter(names[0]);
    const number = parameter.number === null ? "" : `${String(parameter.number).padStart(2, "0")} `;
    const explain = () => this.#controller.ask(this.#controller.clock.time, names.length > 1 ? base : names[0]);
    const away = () => this.#graphs.toggle(base);
    const title = `Why does ${spoken(base)} have its value at the playhead?`;
    return [
      h("button", { class: "tl-graph-name", "data-name": base, title, onclick: explain }, number + spoken(base)),
      this.#side(base),
      h("button", { "aria-label": `Remove the graph of ${spoken(base)}`, title: "Remove", onclick: away }, "×"),
    ];
  }

  /** @param {string} base */
  #side(base) {
    if (this.#controller.scene.model.base(base).names.length < 2) return null;
    const side = this.#graphs.side(base);
    const next = SIDES[(SIDES.indexOf(side) + 1) % SIDES.length];
    const label = `${SIGNS[side]}, ${spoken(base)}: ${side === "both" ? "both sides" : `${side} side`}; show and draw ${next}`;
    const turn = () => this.#graphs.setSide(base, next);
    return h("button", { class: "tl-side", "aria-label": label, title: label, "data-name": `${base} side`, onclick: turn },
      SIGNS[side]); // prettier-ignore
  }
}
