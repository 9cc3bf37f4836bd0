import { Adder } from "./adder.js";
import { BlockList } from "./blocklist.js";
import { Desk } from "./desk.js";
import { Details } from "./details.js";
import { h } from "./dom.js";
import { Edits } from "./edits.js";
import { Graphs } from "./graphs.js";
import { Model } from "./model.js";
import { Names } from "./names.js";
import { Overview } from "./overview.js";
import { clockTime } from "./paint_head.js";
import { onTheme, paletteOf } from "./palette.js";
import { Picker } from "./picker.js";
import { listen } from "./pointer.js";
import { Scene } from "./scene.js";
import { Shapes } from "./shape.js";
import { shortcuts } from "./shortcuts.js";
import { Tools } from "./tools.js";
import { Viewport } from "./viewport.js";
import { Why } from "./why.js";

export { TIMELINE_KEYS } from "./shortcuts.js";

/**
 * Show the timeline of a take.
 *
 * @param {HTMLElement} element where it is shown; it fills the element, and scrolls within it
 * @param {object} studio
 * @param {import("../store.js").Store} studio.store
 * @param {import("../connection.js").Connection} studio.connection
 * @param {import("../clock.js").Clock} studio.clock
 * @param {import("../actions.js").Actions} studio.actions
 * @param {HTMLElement} studio.explanation where explanations are shown, beside the stage
 * @returns {Timeline} also the element's `timeline`
 */
export function mountTimeline(element, studio) {
  element.timeline = new Timeline(element, studio);
  return element.timeline;
}

/** Whether two takes are of the same line, so that what is in sight may stay. */
function sameLine(one, other) {
  return one.duration === other.duration && one.speech?.text === other.speech?.text;
}

class Timeline {
  #store;
  #clock;
  #scene;
  #desk;
  #graphs;
  #details;
  #edits;
  #parts;
  #root;
  #frame = 0;
  #said = null;
  #kept = null;

  constructor(element, { store, clock, actions, explanation }) {
    this.#store = store;
    this.#clock = clock;
    const repaint = () => this.repaint();
    this.#edits = new Edits(actions, repaint);
    this.#details = new Details(actions, repaint);
    this.#graphs = new Graphs(() => this.#rearrange());
    this.#build(element, actions, explanation);
    this.#listen();
  }

  /** What is drawn and how much of it: for tests and for the curious. */
  get scene() {
    return this.#scene;
  }

  /** What the user can do, by name. */
  get desk() {
    return this.#desk;
  }

  /** Draw anew with the page's next frame. */
  repaint() {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#paint();
    });
  }

  #build(element, actions, explanation) {
    const canvas = h("canvas", { id: "tl-canvas", tabindex: "-1", role: "img" });
    const playhead = h("div", { class: "tl-playhead" });
    const frame = h("div", { class: "tl-window" }, canvas, playhead);
    const depth = h("div", { class: "tl-depth" });
    const scroller = h("div", { class: "tl-scroller" });
    const status = h("div", { class: "tl-status" });
    const empty = h("p", { class: "tl-empty" }, "The timeline of what you perform stands here.");
    this.#root = h("div", { class: "tl" });
    this.#scene = new Scene(canvas, { view: new Viewport(), edits: this.#edits, details: this.#details });
    const [scene, edits, details, clock, store] = [this.#scene, this.#edits, this.#details, this.#clock, this.#store];
    const repaint = () => this.repaint();
    this.#desk = new Desk({ scene, edits, details, clock, actions, store, scroller, repaint, arrange: () => this.#rearrange() });
    const adder = new Adder(this.#root, this.#desk);
    const picker = new Picker(this.#root, this.#desk, this.#graphs);
    const add = (time = this.#clock.time, channel = null) => scene.model && adder.open(time, channel);
    const list = new BlockList(this.#root, this.#desk);
    const tools = new Tools(this.#root, this.#desk, {
      add: () => add(),
      blocks: () => list.focus(),
      graphs: picker.button(),
    });
    const names = new Names(scroller, this.#desk, this.#graphs);
    scroller.append(frame, depth);
    this.#root.append(scroller, status);
    const overview = new Overview(this.#root, this.#desk);
    this.#root.append(empty);
    element.replaceChildren(this.#root);
    const why = new Why(explanation, this.#desk);
    this.#parts = { canvas, playhead, frame, depth, scroller, status, empty, list, tools, names, overview, why };
    listen(canvas, this.#desk, { add, walk: () => list.focus() });
    shortcuts(this.#root, this.#desk, add);
  }

  #listen() {
    const { scroller } = this.#parts;
    scroller.addEventListener("scroll", () => {
      this.#scene.scroll = scroller.scrollTop / this.#scene.unit;
      this.#parts.names.scroll();
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

  /** Take up the store's take. */
  #takeUp() {
    const [take, catalogue] = [this.#store.get("take"), this.#store.get("catalogue")];
    const before = this.#scene.model;
    this.#root.classList.toggle("tl-idle", !take);
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
    this.#parts.list.setModel(model);
    this.#select();
  }

  /** The user has other graphs or lanes: lay out, and have it kept with the project. */
  #rearrange() {
    this.#kept = { ...this.#graphs.kept, folded: [...this.#scene.folded] };
    this.#arrange();
    this.#store.set({ graphs: this.#kept });
  }

  /** Show what was kept with the project. */
  #restore() {
    const kept = this.#store.get("graphs");
    if (!kept || kept === this.#kept || !this.#scene.model) return;
    this.#kept = kept;
    this.#graphs.restore(kept, this.#scene.model);
    this.#scene.folded = new Set(kept.folded);
    this.#arrange();
  }

  #arrange() {
    const { scene } = this.#desk;
    if (!scene.model) return;
    scene.graphs = this.#graphs.rows;
    scene.arrange();
    this.#resize();
    this.#parts.names.show();
  }

  #resize() {
    const { scroller, frame, names, depth } = this.#parts;
    const height = scroller.clientHeight;
    frame.style.height = `${height}px`;
    names.setHeight(height);
    if (frame.clientWidth > 0) this.#scene.resize(frame.clientWidth, height);
    const whole = this.#scene.model ? (this.#scene.headHeight + this.#scene.bodyHeight) * this.#scene.unit : 0;
    depth.style.height = `${Math.max(whole - height, 0)}px`;
    this.repaint();
  }

  #dress() {
    const catalogue = this.#store.get("catalogue");
    if (!catalogue) return;
    this.#scene.palette = paletteOf(this.#root, catalogue.channels.map(({ name }) => name));
    this.repaint();
  }

  #select() {
    const selection = this.#store.get("selection") ?? { time: null, parameter: null, movement: null };
    const { time, parameter, movement } = selection;
    this.#scene.selected = this.#scene.model?.blocks.has(movement) ? movement : null;
    this.#scene.marked = parameter && this.#scene.model ? { time, name: this.#scene.model.named(parameter)[0] } : null;
    if (this.#scene.selectedKey?.parameter !== parameter) this.#scene.selectedKey = null;
    this.#parts.list.setSelected(this.#scene.selected);
    this.#parts.why.show(selection);
    if (this.#scene.selected !== null && movement !== this.#desk.chosen) {
      this.#desk.chosen = movement;
      this.#desk.reveal(this.#desk.block); // it was pointed at elsewhere on the page
    }
    this.repaint();
  }

  #tick() {
    const { scene } = this.#desk;
    scene.time = this.#clock.time;
    if (!scene.model) return;
    const follow = () => (this.#clock.playing ? scene.view.follow(scene.time) : scene.view.reveal(scene.time));
    if (this.#desk.follows && follow()) this.repaint();
    const word = scene.model.speech?.words.at(scene.time) ?? null;
    const phone = scene.model.speech?.phones.at(scene.time) ?? null;
    if (word !== this.#said?.word || phone !== this.#said?.phone) this.repaint();
    this.#said = { word, phone };
    this.#showTime();
  }

  #showTime() {
    const { scene } = this.#desk;
    this.#parts.playhead.style.transform = `translateX(${scene.view.x(scene.time) * scene.unit}px)`;
    this.#parts.names.setTime(`${clockTime(scene.time)} s`);
  }

  #paint() {
    const { scene } = this.#desk;
    if (!scene.palette) return;
    scene.paint();
    for (const row of scene.model ? scene.visible() : []) {
      if (row.kind === "graph") this.#details.want(row.names[0]);
    }
    this.#showTime();
    const { tools, overview, why, status, canvas } = this.#parts;
    tools.show();
    overview.show();
    why.refresh();
    const { model } = scene;
    if (!model) return;
    const drawn = model.take.blocks.length;
    status.textContent = `${drawn} movements`;
    canvas.setAttribute("aria-label", `Timeline of ${model.duration.toFixed(1)} seconds with ${drawn} movements; `
      + "the list of movements has them for the keyboard"); // prettier-ignore
  }
}
