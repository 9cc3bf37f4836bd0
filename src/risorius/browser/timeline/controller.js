import { clipboard, copy, pasted } from "./edit/clipboard.js";
import { movedTogether, spanOf } from "./edit/group.js";
import { moved, pulled, stretchedTogether, timesOf } from "./model/times.js";
/** @import {Block, BodyRow} from "../types.js" */
/** @import {Marker} from "../wire.js" */

const PATIENCE = 350; // ms after the last key press until keyboard edits are sent

/**
 * @typedef {Object} Parts
 * @property {import("./paint/scene.js").Scene} scene
 * @property {import("./model/graphs.js").Graphs} graphs
 * @property {import("./edit/edits.js").Edits} edits
 * @property {import("./model/details.js").Details} details
 * @property {import("../player/clock.js").Clock} clock
 * @property {import("../studio/actions.js").Actions} actions
 * @property {import("../studio/store.js").Store} store
 * @property {HTMLElement} scroller
 * @property {() => void} repaint redraws with the page's next frame
 * @property {() => void} arrange updates the layout
 */

/**
 * The timeline's actions, shared by pointer, keys and buttons.
 */
export class TimelineController {
  snaps = true;
  follows = true;
  draws = false; // whether a pointer draws on graphs
  /** @type {string | null} the block that was last selected in the timeline, not elsewhere on the page */
  chosen = null;
  /** @type {Block | null} the block whose times were changed by keys and not sent yet */
  #nudged = null;
  /** @type {Block[] | null} the same of several blocks */
  #nudgedAll = null;
  #timer = 0;

  /** @param {Parts} parts */
  constructor({ scene, graphs, edits, details, clock, actions, store, scroller, repaint, arrange }) {
    this.scene = scene;
    this.graphs = graphs;
    this.edits = edits;
    this.details = details;
    this.clock = clock;
    this.actions = actions;
    this.store = store;
    this.scroller = scroller;
    this.repaint = repaint;
    this.arrange = arrange;
  }

  /**
   * Select a block (null: none), and explain it at a time within it.
   * @param {Block | null} block @param {number | null} [time]
   */
  choose(block, time = null) {
    if (block?.id !== this.#nudged?.id || this.#nudgedAll) this.settle();
    this.scene.selectedKey = null;
    this.scene.group.clear();
    if (block === null) {
      this.actions.select({});
      this.repaint();
      return;
    }
    const shown = this.edits.shown(block) ?? block;
    const at = time ?? (shown.apex_start + shown.apex_end) / 2;
    this.chosen = block.id;
    this.actions.select({ movement: block.id, time: Math.min(at, this.scene.model.duration) });
  }

  /** Select several blocks; the last one is explained. @param {Block[]} blocks */
  chooseAll(blocks) {
    const all = new Map(blocks.filter(({ free }) => free).map((block) => [block.id, block]));
    this.choose([...all.values()].at(-1) ?? null);
    if (all.size > 1) this.scene.group = new Set(all.keys());
    this.repaint();
  }

  /** Add a block to the selection, or remove it. @param {Block} block */
  toggle(block) {
    const { blocks } = this;
    const rest = blocks.filter(({ id }) => id !== block.id);
    this.chooseAll(rest.length < blocks.length ? rest : [...blocks, block]);
  }

  /** Select all movements of the selected one's lane. */
  chooseLane() {
    const { block } = this;
    const lane = block && this.scene.model.lanes.find(({ channel }) => channel === block.channel);
    if (lane) this.chooseAll([...lane.spans.items.filter(({ id }) => id !== block.id), block]);
  }

  /** @returns {Block[]} all selected blocks */
  get blocks() {
    const { group, model } = this.scene;
    if (group.size > 1) return [...group].flatMap((id) => model.blocks.get(id) ?? []);
    return this.block ? [this.block] : [];
  }

  /** Ask why a parameter, or both sides of one, has its value at a time. @param {number} time @param {string} parameter */
  ask(time, parameter) {
    this.settle();
    const at = Math.max(0, Math.min(time, this.scene.model.duration));
    this.actions.select({ time: at, parameter });
  }

  /** @param {string} parameter @param {number} index */
  chooseKey(parameter, index) {
    this.scene.selectedKey = { parameter, index };
    const [time] = this.edits.keys(parameter)[index];
    this.actions.select({ time, parameter });
  }

  /** @returns {Block | null} the selected block */
  get block() {
    return this.scene.model?.blocks.get(this.scene.selected ?? "") ?? null;
  }

  /**
   * Change the selected block by some frames; sent after a pause in key presses.
   * @param {number} frames
   * @param {"move" | 0 | 1 | 2 | 3} what "move", or the index of one of its times
   */
  nudge(what, frames) {
    const { block, blocks } = this;
    if (!block?.free) return;
    const { duration, frame } = this.scene.model;
    if (blocks.length > 1) {
      this.#nudgeAll(blocks, what, frames * frame, duration);
      return;
    }
    const times = timesOf(this.edits.shown(block) ?? block);
    const delta = frames * frame;
    const after = what === "move" ? moved(times, delta, duration) : pulled(times, what, times[what] + delta, duration);
    this.#nudged = block;
    this.edits.hold(block, after);
    this.reveal(block);
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.settle(), PATIENCE);
  }

  /**
   * Start and end stretch the selection as a whole; onset and offset change in each block.
   * @param {Block[]} blocks @param {"move" | 0 | 1 | 2 | 3} what @param {number} delta @param {number} duration
   */
  #nudgeAll(blocks, what, delta, duration) {
    const times = blocks.map((block) => timesOf(this.edits.shown(block) ?? block));
    const [first, last] = spanOf(this.scene) ?? [0, 0];
    const after = () => {
      if (what === "move") return movedTogether(times, delta, duration);
      if (what === 0) return stretchedTogether(times, last, first, first + delta, duration);
      if (what === 3) return stretchedTogether(times, first, last, last + delta, duration);
      return times.map((own) => pulled(own, what, own[what] + delta, duration));
    };
    this.#nudgedAll = blocks;
    this.edits.holdAll(blocks, after());
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.settle(), PATIENCE);
  }

  /** Send the keyboard edits. @returns {Promise<any>} resolves when the answer has arrived */
  async settle() {
    clearTimeout(this.#timer);
    const block = this.#nudged;
    this.#nudged = null;
    const blocks = this.#nudgedAll;
    this.#nudgedAll = null;
    if (blocks) await this.edits.sendAll(blocks);
    if (block) await this.edits.send(block);
  }

  /** Set one of the selected block's times, in seconds. @param {number} what @param {number} time */
  setTime(what, time) {
    const { block } = this;
    if (block === null) return;
    const times = timesOf(this.edits.shown(block) ?? block);
    this.edits.hold(block, pulled(times, what, time, this.scene.model.duration));
    this.edits.send(block);
  }

  /** Delete the selected key, or else the selected block. */
  remove() {
    if (this.scene.selectedKey) {
      this.removeKey(this.scene.selectedKey);
      return;
    }
    const { block, blocks } = this;
    if (!block?.free) return;
    clearTimeout(this.#timer);
    this.#nudged = this.#nudgedAll = null;
    if (blocks.length > 1) {
      this.edits.holdAll(blocks, null);
      this.edits.sendAll(blocks);
    } else this.edits.remove(block);
  }

  /** Return both sides of a parameter if their keys are the same, else the parameter alone. @param {string} parameter */
  partners(parameter) {
    const { base } = this.scene.model.parameter(parameter);
    const keys = JSON.stringify(this.edits.keys(parameter));
    const { names } = this.scene.model.base(base);
    return names.filter((name) => name === parameter || JSON.stringify(this.edits.keys(name)) === keys);
  }

  /** @param {{parameter: string, index: number}} key */
  removeKey({ parameter, index }) {
    const keys = this.edits.keys(parameter).filter((_, k) => k !== index);
    this.scene.selectedKey = null;
    return this.edits.sendKeys(this.partners(parameter), keys);
  }

  /** Copy the selected movements, to be pasted here or in another session. @returns {Promise<boolean>} whether there were any */
  async copy() {
    await this.settle();
    return copy(this);
  }

  /** Copy the selected movements and delete them. */
  async cut() {
    if (await this.copy()) this.remove();
  }

  /** Paste the copied movements at the playhead, as one change, and select them. */
  async paste() {
    await this.settle();
    const movements = clipboard();
    if (movements.length === 0) return;
    const before = new Set(this.scene.model.blocks.keys());
    const edits = pasted(movements, this.clock.time, this.scene.model.duration);
    if ((await this.actions.editAll(edits)) === null) return;
    const added = [...this.scene.model.blocks.values()].filter(({ id }) => !before.has(id));
    this.chooseAll(added);
    if (added.length) this.reveal(added[0]);
  }

  /**
   * Turn muting, solo or locking of a lane on or off.
   * @param {"muted" | "solo" | "locked"} state @param {string} channel
   */
  async turnLane(state, channel) {
    await this.settle();
    const lanes = this.scene.model.states;
    const now = lanes[state];
    const after = now.includes(channel) ? now.filter((name) => name !== channel) : [...now, channel];
    await this.actions.setLanes({ ...lanes, [state]: after });
  }

  /** Whether a lane is locked against changes. @param {string} channel */
  locks(channel) {
    return this.scene.model.states.locked.includes(channel);
  }

  /** @param {Marker[]} markers */
  setMarkers(markers) {
    return this.actions.setMarkers(markers);
  }

  /** Set a marker at the playhead. @returns {Promise<number>} its index */
  async addMarker() {
    const { markers } = this.scene.model;
    const { time } = this.clock;
    /** @param {Marker} one */
    const near = (one) => Math.abs(one.time - time) < 1e-3;
    if (!markers.some(near)) await this.setMarkers([...markers, { time, text: "" }]);
    return this.scene.model.markers.findIndex(near);
  }

  /** Go to the marker before or after the playhead. @param {-1 | 1} way */
  goMarker(way) {
    const { time } = this.clock;
    const there = this.scene.model.markers.filter((one) => way * (one.time - time) > 1e-3);
    const next = way > 0 ? there[0] : there.at(-1);
    if (next) this.clock.seek(next.time);
  }

  async undo() {
    await this.settle();
    await this.actions.undo();
  }

  async redo() {
    await this.settle();
    await this.actions.redo();
  }

  /** Scroll a block into view. @param {Block} block */
  reveal(block) {
    const shown = this.edits.shown(block) ?? block;
    this.scene.view.reveal(shown.start, shown.end);
    this.revealRow(this.scene.body.find((row) => row.kind === "lane" && row.lane.channel === block.channel));
    this.repaint();
  }

  /** Fold a lane to one row, or unfold it. @param {string} channel */
  fold(channel) {
    const { folded } = this.scene;
    if (!folded.delete(channel)) folded.add(channel);
    this.arrange();
  }

  /** @param {BodyRow | undefined} row */
  revealRow(row) {
    if (!row) return;
    const { scroll, height, headHeight, unit } = this.scene;
    const room = height - headHeight;
    const top = Math.min(row.y, Math.max(scroll, row.y + Math.min(row.height, room) - room));
    if (top !== scroll) this.scroller.scrollTop = top * unit;
  }

  /** Loop over the word at a time. @param {number} time */
  loopWord(time) {
    const word = this.scene.model.speech?.words.at(time);
    if (word) this.clock.setLoop([word.start, word.end]);
  }

  /** @param {number} factor @param {number} [x] */
  zoom(factor, x = this.scene.view.x(this.clock.time)) {
    const { view } = this.scene;
    view.zoom(factor, x >= 0 && x <= view.width ? x : view.width / 2);
    this.repaint();
  }

  fit() {
    this.scene.view.fit();
    this.repaint();
  }
}
