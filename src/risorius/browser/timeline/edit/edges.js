/**
 * Correct phone boundaries: drag them on the rows of words and phones, or move them by keys at the playhead. The sound
 * stays; everything that depends on the phones follows.
 */

/** @import {SpeechRow} from "../../types.js" */
/** @import {PhoneView} from "../../wire.js" */
/** @import {TimelineController} from "../controller.js" */
/** @import {Scene} from "../paint/scene.js" */

const NEAR = 5; // pixels
const APART = 0.01; // s between two edges
const STEP = 0.01; // s a key moves by

/**
 * Return the index of the phone that begins near a place on the rows of words or phones; -1 if none there can be moved.
 * @param {Scene} scene @param {SpeechRow | null} row @param {number} x
 */
export function edgeNear(scene, row, x) {
  const { model, view } = scene;
  if (!model.speech || (row?.kind !== "phones" && row?.kind !== "words")) return -1;
  const phones = model.take.speech?.phones ?? [];
  /** @param {number} k */
  const far = (k) => Math.abs(view.x(phones[k].start) - x);
  const around = [...model.speech.phones.within(view.time(x - NEAR), view.time(x + NEAR))];
  const near = around.map((phone) => phones.indexOf(phone)).filter((k) => movable(phones, k, row.kind) && far(k) <= NEAR);
  return near.sort((a, b) => far(a) - far(b))[0] ?? -1;
}

/**
 * Whether a phone's beginning is an edge of a word or of a phone in one.
 * @param {PhoneView[]} phones @param {number} k @param {string} kind
 */
function movable(phones, k, kind) {
  if (k < 1 || (phones[k].word < 0 && phones[k - 1].word < 0)) return false;
  return kind === "phones" || phones[k].word !== phones[k - 1].word;
}

/**
 * Return the earliest and latest time of an edge.
 * @param {PhoneView[]} phones @param {number} k @returns {[low: number, high: number]}
 */
function bounds(phones, k) {
  return [phones[k - 1].start + APART, phones[k].end - APART];
}

/** Drag an edge; the sound's outline above helps to find the place. */
export class DragEdge {
  #controller;
  #phone;
  #x;
  /** @type {number | null} */
  #time = null;

  /** @param {TimelineController} controller @param {number} x @param {number} phone */
  constructor(controller, x, phone) {
    this.#controller = controller;
    this.#phone = phone;
    this.#x = x;
  }

  /** @param {number} x */
  move(x) {
    if (this.#time === null && Math.abs(x - this.#x) < 2) return;
    const { scene } = this.#controller;
    const phones = scene.model.take.speech?.phones ?? [];
    const [low, high] = bounds(phones, this.#phone);
    this.#time = Math.max(low, Math.min(phones[this.#phone].start + (x - this.#x) / scene.view.scale, high));
    scene.guide = this.#time;
    this.#controller.repaint();
  }

  async end() {
    const { actions, scene } = this.#controller;
    if (this.#time !== null) await actions.relabel(this.#phone, this.#time);
    scene.guide = null;
    this.#controller.repaint();
  }

  cancel() {
    this.#controller.scene.guide = null;
    this.#controller.repaint();
  }
}

/**
 * Move the edge nearest to a time by a step.
 * @param {import("../controller.js").TimelineController} controller @param {number} time @param {number} steps
 */
export function nudgeEdge({ scene: { model }, actions }, time, steps) {
  const phones = model.take.speech?.phones ?? [];
  const all = phones.map((_, k) => k).filter((k) => movable(phones, k, "phones"));
  /** @param {number} k */
  const far = (k) => Math.abs(phones[k].start - time);
  const phone = all.sort((a, b) => far(a) - far(b))[0];
  if (phone === undefined) return;
  const [low, high] = bounds(phones, phone);
  actions.relabel(phone, Math.max(low, Math.min(phones[phone].start + steps * STEP, high)));
}
