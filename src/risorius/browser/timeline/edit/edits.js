import { editsOf } from "./group.js";
import { fieldsOf } from "../model/key_shapes.js";
import { Preview } from "./preview.js";
import { editOf, timesOf } from "../model/times.js";
/** @import {Block, Edit, Key, Times} from "../../types.js" */

/**
 * Edits in progress: shown at once, sent to the server, and dropped when the answer arrives.
 */
export class Edits {
  /** @type {Map<string, Times | null>} */
  #blocks = new Map(); // id -> its four shown times, or null if it is deleted
  /** @type {Map<string, Key[]>} */
  #keys = new Map(); // parameter -> keys
  #sent = new Map(); // the last edit sent for an id or a parameter
  #actions;
  #changed;
  /** @type {import("../model/model.js").Model} */
  #model = /** @type {any} */ (null);
  #preview;

  /**
   * @param {import("../../studio/actions.js").Actions} actions
   * @param {() => void} changed called when something shown has changed
   * @param {() => number | null} standing time of the playhead; null while it runs
   */
  constructor(actions, changed, standing) {
    this.#actions = actions;
    this.#changed = changed;
    this.#preview = new Preview(actions, changed, standing);
  }

  /** @param {import("../model/model.js").Model} model model that the edits apply to */
  setModel(model) {
    this.#model = model;
    this.#preview.setModel(model);
  }

  /** The ids of the blocks shown differently from the take. */
  get held() {
    return this.#blocks.keys();
  }

  /** @param {string} id */
  has(id) {
    return this.#blocks.has(id);
  }

  /** Return a block as shown; null if it is deleted. @param {Block} block @returns {Block | null} */
  shown(block) {
    const times = this.#blocks.get(block.id);
    if (times === undefined) return block;
    if (times === null) return null;
    const [start, apex_start, apex_end, end] = times;
    return { ...block, start, apex_start, apex_end, end };
  }

  /** Return the shown keys of a parameter. @param {string} name @returns {Key[]} */
  keys(name) {
    return this.#keys.get(name) ?? this.#model?.drawn.get(name) ?? [];
  }

  /** Show a block at other times, without telling the server yet. @param {Block} block @param {Times | null} times */
  hold(block, times) {
    this.#blocks.set(block.id, times);
    if (times) this.#preview.show(editsOf([block], [times]));
    this.#changed();
  }

  /** Show several blocks at other times (null: deleted). @param {Block[]} blocks @param {Times[] | null} times */
  holdAll(blocks, times) {
    blocks.forEach((block, k) => this.#blocks.set(block.id, times === null ? null : times[k]));
    if (times) this.#preview.show(editsOf(blocks, times));
    this.#changed();
  }

  /**
   * Send the edited times of several blocks, or their deletion, as one change.
   * @param {Block[]} blocks @returns {Promise<any>}
   */
  async sendAll(blocks) {
    const gone = blocks.every(({ id }) => this.#blocks.get(id) === null);
    const times = blocks.map((block) => this.#blocks.get(block.id) ?? timesOf(block));
    const edits = gone ? blocks.map(({ id }) => ({ kind: "delete", movement: id })) : editsOf(blocks, times);
    const answer = edits.length > 0 ? await this.#actions.editAll(edits) : null;
    for (const { id } of blocks) this.drop(id);
    return answer;
  }

  /** @param {string[]} names @param {Key[]} keys */
  holdKeys(names, keys) {
    for (const name of names) this.#keys.set(name, keys);
    const { kind, fields } = this.#keyEdit(names, keys);
    this.#preview.show([{ kind, ...fields }]);
    this.#changed();
  }

  /** Show the take's own times again. @param {string} id */
  drop(id) {
    this.#blocks.delete(id);
    this.#preview.end();
    this.#changed();
  }

  /** @param {string[]} names */
  dropKeys(names) {
    for (const name of names) this.#keys.delete(name);
    this.#preview.end();
    this.#changed();
  }

  /**
   * Send a block's edited times.
   * @param {Block} block @returns {Promise<any>} the answer, null if refused or nothing changed
   */
  async send(block) {
    const times = this.#blocks.get(block.id);
    const edit = times ? blockEdit(block, times) : null;
    if (edit === null) {
      this.drop(block.id);
      return null;
    }
    return this.#sending(block.id, edit.kind, edit.fields, () => this.drop(block.id));
  }

  /** @param {Block} block */
  async remove(block) {
    this.hold(block, null);
    return this.#sending(block.id, "delete", { movement: block.id }, () => this.drop(block.id));
  }

  /**
   * Set the keys of the parameters (one, or both sides of one); an empty list removes the manual curves.
   * @param {string[]} names @param {Key[]} keys
   */
  sendKeys(names, keys) {
    this.holdKeys(names, keys);
    const { kind, fields } = this.#keyEdit(names, keys);
    return this.#sending(fields.parameter, kind, fields, () => this.dropKeys(names));
  }

  /** @param {string[]} names @param {Key[]} keys @returns {Edit} */
  #keyEdit(names, keys) {
    const parameter = names.length > 1 ? this.#model.parameter(names[0]).base : names[0];
    if (keys.length === 0) return { kind: "clear_keys", fields: { parameter } };
    return { kind: "keys", fields: { parameter, ...fieldsOf(keys) } };
  }

  /**
   * Send an edit; `over` is called when its answer arrives, unless a newer edit for the same `what` was sent.
   * @param {string} what @param {string} kind @param {Record<string, any>} fields @param {() => void} over
   */
  async #sending(what, kind, fields, over) {
    const ticket = {};
    this.#sent.set(what, ticket);
    const answer = await this.#actions.edit(kind, fields);
    if (this.#sent.get(what) === ticket) {
      this.#sent.delete(what);
      over();
    }
    return answer;
  }
}

/**
 * Return the wire's edit that changes a block's times; null if they are unchanged.
 * @param {Block} block @param {Times} times @returns {Edit | null}
 */
function blockEdit(block, times) {
  const edit = editOf(timesOf(block), times);
  return edit && { ...edit, fields: { movement: block.id, ...edit.fields } };
}
