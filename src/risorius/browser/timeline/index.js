import { TimelineController } from "./controller.js";
import { Details } from "./model/details.js";
import { Edits } from "./edit/edits.js";
import { fitted, frameOf } from "./frame.js";
import { Graphs } from "./model/graphs.js";
import { Model } from "./model/model.js";
import { clockTime } from "./paint/paint_head.js";
import { onTheme, paletteOf } from "./paint/palette.js";
import { Said } from "./lists/said.js";
import { Scene } from "./paint/scene.js";
import { Shapes } from "./model/shape.js";
import { Viewport } from "./model/viewport.js";
/** @import {Take} from "../studio/store.js" */
/** @import {Studio} from "../studio/studio.js" */

export { TIMELINE_KEYS } from "./shortcuts.js";

/**
 * Show the timeline of a take.
 *
 * @param {HTMLElement} element parent, which the timeline fills and scrolls within
 * @param {import("../studio/studio.js").Studio & {explanation: HTMLElement}} studio and element for explanations
 * @returns {Timeline} also the element's `timeline`
 */
export function mountTimeline(element, studio) {
  return Object.assign(element, { timeline: new Timeline(element, studio) }).timeline;
}

/** Whether two takes are of the same line; then scroll and zoom stay. @param {Take} one @param {Take} other */
function sameLine(one, other) {
  return one.duration === other.duration && one.speech?.text === other.speech?.text;
}

class Timeline {
  #store;
  #clock;
  #scene;
  #controller;
  #graphs;
  #details;
  #edits;
  #parts;
  #around;
  #painting = false; // whether the page's next frame redraws
  #said;
  /** @type {object | null} */
  #kept = null;

  /** @param {HTMLElement} element @param {Studio & {explanation: HTMLElement}} studio */
  constructor(element, { store, clock, actions, explanation }) {
    this.#store = store;
    this.#clock = clock;
    const repaint = () => this.repaint();
    this.#edits = new Edits(actions, repaint, () => (clock.playing ? null : clock.time));
    this.#details = new Details(actions, repaint);
    const arrange = () => this.#rearrange();
    this.#graphs = new Graphs(arrange);
    this.#parts = frameOf();
    const [edits, details, { canvas, scroller }] = [this.#edits, this.#details, this.#parts];
    this.#scene = new Scene(canvas, { view: new Viewport(), edits, details });
    this.#said = new Said(this.#parts.frame, this.#scene);
    const made = { scene: this.#scene, graphs: this.#graphs, edits, details, clock, actions, store, scroller, repaint, arrange };
    this.#controller = new TimelineController(made);
    this.#around = fitted(this.#parts, this.#controller, this.#graphs, explanation);
    element.replaceChildren(this.#parts.root);
    this.#listen();
  }

  /** The scene: for tests, and for the browser's console. */
  get scene() {
    return this.#scene;
  }

  /** The user's actions by name. */
  get controller() {
    return this.#controller;
  }

  /** Redraw with the page's next frame. */
  repaint() {
    if (this.#painting) return;
    this.#painting = true;
    requestAnimationFrame(() => {
      this.#painting = false;
      this.#paint();
    });
  }

  #listen() {
    const { scroller } = this.#parts;
    scroller.addEventListener("scroll", () => {
      this.#scene.scroll = scroller.scrollTop / this.#scene.unit;
      this.#around.names.scroll();
      this.repaint();
    });
    new ResizeObserver(() => this.#resize()).observe(scroller);
    onTheme(() => this.#dress());
    this.#store.watch(["catalogue", "take"], () => this.#takeUp());
    this.#store.watch(["selection"], () => this.#select());
    this.#store.watch(["graphs"], () => this.#restore());
    this.#clock.on("tick", () => this.#tick());
    this.#clock.on("state", () => {
      this.#scene.loop = this.#clock.loop;
      this.repaint();
    });
  }

  /** Show the store's take. */
  #takeUp() {
    const [take, catalogue] = [this.#store.get("take"), this.#store.get("catalogue")];
    const before = this.#scene.model;
    this.#parts.root.classList.toggle("tl-idle", !take);
    if (!take || !catalogue) return;
    const fresh = before === null || !sameLine(before.take, take);
    const model = new Model(take, catalogue, fresh ? null : before);
    this.#scene.model = model;
    if (before === null) this.#dress();
    this.#scene.shapes ??= new Shapes(catalogue);
    this.#edits.setModel(model);
    this.#details.setTake(take.take, fresh);
    this.#graphs.setModel(model, fresh);
    this.#arrange();
    if (fresh) this.#scene.view.open();
    this.#around.list.setModel(model);
    this.#follow(before);
    this.#select();
  }

  /**
   * Explain a moved or stretched selection at its new time.
   * @param {Model | null} before
   */
  #follow(before) {
    const { group } = this.#scene;
    for (const id of group) if (!this.#scene.model.blocks.has(id)) group.delete(id);
    if (group.size > 1) return;
    const { movement, time } = this.#store.get("selection");
    const [now, was] = [this.#scene.model, before].map((model) => model?.blocks.get(movement ?? ""));
    if (!now || !was || (now.start === was.start && now.end === was.end)) return;
    if (time === null || time < now.start || time > now.end || now.start !== was.start) this.#controller.choose(now);
  }

  /** Graphs or lanes changed: update the layout, and save them with the project. */
  #rearrange() {
    this.#kept = { ...this.#graphs.kept, folded: [...this.#scene.folded] };
    this.#arrange();
    this.#store.set({ graphs: this.#kept });
  }

  /** Show the graphs and lanes saved with the project. */
  #restore() {
    const kept = this.#store.get("graphs");
    if (!kept || kept === this.#kept || !this.#scene.model) return;
    this.#kept = kept;
    this.#graphs.restore(kept, this.#scene.model);
    this.#scene.folded = new Set(kept.folded);
    this.#arrange();
  }

  #arrange() {
    const { scene } = this.#controller;
    if (!scene.model) return;
    scene.graphs = this.#graphs.rows;
    scene.arrange();
    this.#resize();
    this.#around.names.show();
  }

  #resize() {
    const [{ scroller, frame, depth }, { names }] = [this.#parts, this.#around];
    const height = scroller.clientHeight;
    frame.style.height = `${height}px`;
    names.setHeight(height);
    const { unit } = this.#scene;
    if (frame.clientWidth > 0) this.#scene.resize(frame.clientWidth, height);
    if (this.#scene.model && this.#scene.unit !== unit) names.show();
    const whole = this.#scene.model ? (this.#scene.headHeight + this.#scene.bodyHeight) * this.#scene.unit : 0;
    depth.style.height = `${Math.max(whole - height, 0)}px`;
    this.repaint();
  }

  #dress() {
    const catalogue = this.#store.get("catalogue");
    if (!catalogue) return;
    this.#scene.palette = paletteOf(this.#parts.root, catalogue.channels.map(({ name }) => name));
    this.repaint();
  }

  #select() {
    const selection = this.#store.get("selection") ?? { time: null, parameter: null, movement: null };
    const { time, parameter, movement } = selection;
    this.#scene.selected = this.#scene.model?.blocks.has(movement ?? "") ? movement : null;
    this.#scene.marked = parameter && time !== null && this.#scene.model ? { time, name: this.#scene.model.named(parameter)[0] } : null;
    const key = this.#scene.selectedKey;
    const there = key !== null && key.parameter === parameter && key.index < this.#edits.keys(parameter).length;
    if (!there) this.#scene.selectedKey = null;
    this.#around.list.setSelected(this.#scene.selected);
    this.#around.why.show(selection);
    if (this.#scene.selected !== null && movement !== this.#controller.chosen) {
      this.#controller.chosen = movement;
      const { block } = this.#controller;
      if (block) this.#controller.reveal(block); // it was selected elsewhere on the page
    }
    this.repaint();
  }

  #tick() {
    const { scene } = this.#controller;
    scene.time = this.#clock.time;
    if (!scene.model) return;
    const follow = () => (this.#clock.playing ? scene.view.follow(scene.time) : scene.view.reveal(scene.time));
    if (this.#controller.follows && follow()) this.repaint();
    this.#showTime();
  }

  #showTime() {
    const { scene } = this.#controller;
    this.#parts.playhead.style.transform = `translateX(${scene.view.x(scene.time) * scene.unit}px)`;
    this.#said.show();
    this.#around.names.setTime(`${clockTime(scene.time)} s`);
  }

  #paint() {
    const { scene } = this.#controller;
    if (!scene.palette) return;
    scene.paint();
    for (const row of scene.model ? scene.visible() : []) {
      if (row.kind === "graph") this.#details.want(row.names[0]);
    }
    this.#showTime();
    const [{ tools, overview, why }, { status, canvas }] = [this.#around, this.#parts];
    tools.show();
    overview.show();
    why.refresh();
    const { model } = scene;
    if (!model) return;
    const drawn = model.take.blocks.length;
    status.textContent = `${drawn} movements`;
    canvas.setAttribute("aria-label", `Timeline of ${model.duration.toFixed(1)} seconds with ${drawn} movements; `
      + "with the keyboard, use the list of movements"); // prettier-ignore
  }
}
