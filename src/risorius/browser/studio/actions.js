import { adopted, written } from "./drafts.js";
import { told } from "../parts/dom.js";
import { changedTake, curvesOf, takeOf } from "../player/take.js";
import { Work } from "./work.js";
/** @import {Written} from "../types.js" */

/**
 * The user's actions: each sends a request to the server and puts the answer into the store.
 *
 * Every change of the take goes through here, so that all parts of the page see the same take.
 * If the server refuses an action, the page's notice says so, and the action resolves to null.
 */
export class Actions {
  #store;
  #connection;
  #notify;
  #work;

  /**
   * @param {import("./store.js").Store} store
   * @param {import("./connection.js").Connection} connection
   * @param {(text: string) => void} notify shows a line to the user
   */
  constructor(store, connection, notify) {
    this.#store = store;
    this.#connection = connection;
    this.#notify = notify;
    this.#work = new Work(store, connection);
  }

  /**
   * Perform the store's source with its emotions and choices.
   * @param {() => void} [arrives] called when the take has arrived, before listeners are
   */
  perform(arrives) {
    return this.#changing("perform", written(this.#store), "Performing …", arrives);
  }

  /** Let the server prepare the draft, in case it is performed. */
  prepare() {
    // If that fails, nothing is lost.
    if (this.#store.get("busy") === "") this.#connection.request("prepare", written(this.#store)).catch(() => {});
  }

  /**
   * Perform the same source with other choices or emotions; those left out stay.
   * @param {Partial<Pick<Written, "choices" | "emotions">>} parts `choices` contains only those that changed
   */
  choose({ choices, emotions }) {
    /** @type {Partial<Written>} */
    const asked = {};
    if (choices) asked.choices = { ...this.#store.get("choices"), ...choices };
    if (emotions) asked.emotions = emotions;
    this.#store.set(asked);
    return this.#store.get("take") ? this.#changing("choose", asked, "Performing …") : null;
  }

  /**
   * Move the beginning of a phone; movements follow it.
   * @param {number} phone its index @param {number | null} start seconds; null: as aligned
   */
  relabel(phone, start) {
    return this.#changing("relabel", { phone, start }, "Performing …");
  }

  /**
   * Change the score.
   * @param {string} kind one of the wire's edits: "move", "stretch", "retarget", "add", "delete", "keys", …
   * @param {Record<string, any>} fields as the wire names them
   */
  edit(kind, fields) {
    return this.#changing("edit", { kind, ...fields }, "");
  }

  /** Make several changes of the score as one. @param {Record<string, any>[]} edits each with its `kind` */
  editAll(edits) {
    return this.#changing("edit_all", { edits }, "");
  }

  /**
   * Preview several edits; null if they cannot be made. No notice is shown: the user has not made them yet.
   * @param {Record<string, any>[]} edits as those of `editAll`
   * @param {number | null} face time of the face to show with the edits
   */
  async preview(edits, face) {
    this.#store.set({ preview: face !== null });
    try {
      const answer = await this.#connection.request("preview_all", { edits, face });
      if (face !== null) this.#store.set({ tried: curvesOf(answer.curves) });
      return answer;
    } catch {
      return null;
    }
  }

  /** Show the take's own face again. */
  endPreview() {
    this.#store.set({ preview: false, tried: null });
  }

  /** Set all markers of the line. @param {import("../wire.js").Marker[]} markers */
  setMarkers(markers) {
    return this.#changing("set_markers", { markers }, "");
  }

  /** Set the muted, solo and locked lanes. @param {import("../wire.js").LaneStates} lanes */
  setLanes(lanes) {
    return this.#changing("set_lanes", { lanes }, "");
  }

  /** Restore an edit that did not fit a new text. @param {number} number in the take's `lost` */
  bringBack(number) {
    return this.#changing("bring_back", { number }, "");
  }

  /** Discard the edits that did not fit. */
  letGo() {
    return this.#changing("let_go", {}, "");
  }

  /** Undo the last change. */
  undo() {
    return this.#store.get("take")?.undoes ? this.#changing("undo", {}, "") : null;
  }

  /** Return to the state before a project was opened. */
  undoOpening() {
    return this.#changing("undo", { opened: true }, "");
  }

  /** Redo the last undone change. */
  redo() {
    return this.#store.get("take")?.redoes ? this.#changing("redo", {}, "") : null;
  }

  /**
   * Select something: all parts that show details follow.
   * @param {{time?: number | null, parameter?: string | null, movement?: string | null}} selection
   */
  select({ time = null, parameter = null, movement = null }) {
    this.#store.set({ selection: { time, parameter, movement } });
  }

  /**
   * Ask the server for anything else; null if it refuses, with its line shown.
   * @param {string} verb @param {Record<string, any>} [fields]
   */
  async ask(verb, fields = {}) {
    try {
      return await this.#connection.request(verb, fields);
    } catch (error) {
      this.#notify(told(error));
      return null;
    }
  }

  /**
   * The same for long work: its progress is shown, and it can be stopped.
   * @param {string} verb @param {Record<string, any>} fields @param {string} busy name of the work
   * @returns {Promise<any>} null also where it was stopped
   */
  async work(verb, fields, busy) {
    try {
      return await this.#work.request(verb, fields, busy);
    } catch (error) {
      if (told(error) !== "stopped") this.#notify(told(error));
      return null;
    }
  }

  /**
   * Run long work outside the socket; it can be stopped, too.
   * @template T @param {string} busy @param {(signal: AbortSignal) => Promise<T>} work
   */
  during(busy, work) {
    return this.#work.during(busy, work);
  }

  /** Stop the work in progress. */
  stop() {
    this.#work.stop();
  }

  /** @param {string} verb @param {Record<string, any>} fields @param {string} busy @param {() => void} [arrives] */
  async #changing(verb, fields, busy, arrives = () => {}) {
    this.#store.set({ saved: "saving" });
    const answer = await (busy ? this.work(verb, fields, busy) : this.ask(verb, fields));
    if (answer === null) this.#store.set({ saved: "saved" });
    else {
      arrives();
      this.#take(answer, fields);
    }
    return answer;
  }

  /**
   * Put the answer to a change into the store: a whole take, or the changed parts.
   * @param {any} answer @param {Partial<Written>} asked
   */
  #take(answer, asked) {
    const before = this.#store.get("take");
    const whole = answer.duration !== undefined || answer.whole;
    const take = answer.duration === undefined ? changedTake(/** @type {import("./store.js").Take} */ (before), answer) : takeOf(answer);
    const [first, last] = whole ? [0, take.frames] : [answer.from_frame, answer.to_frame];
    const made = adopted(this.#store, before?.made, take.made, asked);
    this.#store.set({ take, faces: { take: take.take, first, last }, dial: null, ...made });
    for (const line of take.warnings) this.#notify(line);
  }
}
