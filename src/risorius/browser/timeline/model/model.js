import { keysOf } from "./key_shapes.js";
import { Pyramid } from "./pyramid.js";
import { Spans, stacked } from "./spans.js";
/** @import {Take} from "../../studio/store.js" */
/** @import {Around, Base, Block, Speech} from "../../types.js" */
/** @import {Catalogue, ChannelRow, LaneStates, ParameterRow} from "../../wire.js" */

const ALIKE = 1e-4; // smallest visible difference in a graph

/**
 * A take prepared for the timeline: a lane for each channel, its blocks in order, curves to draw.
 *
 * Rebuilt for each take; unchanged parts (curves, speech) are reused from the previous model.
 */
export class Model {
  /** @type {WeakMap<Float32Array, Pyramid>} */
  #pyramids;
  /** @type {WeakMap<Float32Array, WeakMap<Float32Array, boolean>>} whether two curves differ */
  #compared = new WeakMap();
  /** @type {Map<string, Float32Array | null>} curves that an edit in progress changes; null for one that would be at rest */
  previewed = new Map();

  /**
   * @param {Take} take
   * @param {Catalogue} catalogue the server's tables
   * @param {Model | null} before the model of the previous take
   */
  constructor(take, catalogue, before = null) {
    this.take = take;
    this.catalogue = catalogue;
    this.#pyramids = before ? before.#pyramids : new WeakMap();
    this.parameters = new Map(catalogue.parameters.map((parameter) => [parameter.name, parameter]));
    this.bases = basesOf(catalogue.parameters);
    /** The muted, solo and locked lanes. @type {Required<import("../../wire.js").LaneStates>} */
    this.states = /** @type {any} */ (take.lanes);
    const locked = new Set(this.states.locked);
    const blocks = take.blocks.map((block) => ({ ...block, free: block.editable && !locked.has(block.channel) }));
    this.blocks = new Map(blocks.map((block) => [block.id, block]));
    this.lanes = lanesOf(blocks, catalogue.channels);
    this.silent = silentOf(this.states, catalogue.channels);
    /** @type {{time: number, text: string}[]} */
    this.markers = /** @type {any} */ (take.markers);
    this.drawn = new Map(take.drawn.map((curve) => [curve.parameter, keysOf(curve)]));
    /** @type {Speech | null} */
    this.speech = before?.of(take.speech) ?? speechOf(take.speech);
    this.edges = edgesOf(take);
  }

  /** Return the prepared speech if this take has the same one. @param {Take["speech"]} speech @returns {Speech | null} */
  of(speech) {
    return this.take.speech === speech ? this.speech : null;
  }

  get duration() {
    return this.take.duration;
  }

  /** Seconds of a frame. */
  get frame() {
    return 1 / this.take.rate;
  }

  /** @param {string} name @returns {Pyramid | null} the parameter's final curve; null if it is at rest */
  curve(name) {
    const values = this.#shown(name);
    return values ? this.pyramid(values) : null;
  }

  /** @param {Float32Array} values kept as long as they are */
  pyramid(values) {
    const pyramid = this.#pyramids.get(values) ?? new Pyramid(values);
    this.#pyramids.set(values, pyramid);
    return pyramid;
  }

  /** @param {string} name */
  #shown(name) {
    return this.previewed.has(name) ? this.previewed.get(name) : this.take.curves[name];
  }

  /** Return the parameters that a name means: itself, or both sides if it names no side. @param {string} name */
  named(name) {
    return this.bases.get(name)?.names ?? [name];
  }

  /**
   * Whether two parameters' curves differ; those of the two sides are usually the same.
   * @param {string} one @param {string} other
   */
  differ(one, other) {
    const [a, b] = [this.#shown(one), this.#shown(other)];
    if (!a || !b) return Boolean(a) !== Boolean(b);
    const known = this.#compared.get(a) ?? new WeakMap();
    this.#compared.set(a, known);
    if (!known.has(b)) known.set(b, a.some((value, k) => Math.abs(value - b[k]) > ALIKE));
    return known.get(b);
  }

  /** Return the final value of a parameter at a time, interpolated between frames. @param {string} name @param {number} time */
  valueAt(name, time) {
    const values = this.take.curves[name];
    if (!values) return this.parameter(name).neutral;
    const at = Math.max(0, Math.min(time * this.take.rate, values.length - 1));
    const k = Math.min(Math.floor(at), values.length - 2);
    return k < 0 ? values[0] : values[k] + (values[k + 1] - values[k]) * (at - k);
  }

  /** Return a parameter, which must be in the catalogue. @param {string} name */
  parameter(name) {
    return /** @type {ParameterRow} */ (this.parameters.get(name));
  }

  /** Return its name without the side. @param {string} name */
  base(name) {
    return /** @type {Base} */ (this.bases.get(name));
  }

  /** Return the curve that a drawn curve of a parameter joins at its ends. @param {string} name @returns {Around} */
  around(name) {
    return { duration: this.duration, valueAt: (time) => this.valueAt(name, time) };
  }

  /** Names of muscles, without their sides, in order of how far they move in the take. */
  get liveliest() {
    const moved = [...this.bases.values()].map(({ base, names }) => ({ base, travel: this.#travel(names) }));
    return moved.filter(({ travel }) => travel > 0.01).sort((a, b) => b.travel - a.travel).map(({ base }) => base);
  }

  /** @param {string[]} names */
  #travel(names) {
    return Math.max(...names.map((name) => {
      const { low, high, kind } = this.parameter(name);
      const curve = this.curve(name);
      if (!curve || kind !== "muscle") return 0;
      const [least, most] = curve.range(0, curve.length);
      return (most - least) / (high - low);
    }));
  }
}

/**
 * Return the channels without effect: the muted ones, or all except the solo ones.
 * @param {Required<LaneStates>} states @param {ChannelRow[]} channels
 */
function silentOf({ muted, solo }, channels) {
  return new Set(solo.length ? channels.map(({ name }) => name).filter((name) => !solo.includes(name)) : muted);
}

/** @param {ParameterRow[]} parameters @returns {Map<string, Base>} */
function basesOf(parameters) {
  const bases = new Map();
  for (const [base, rows] of Map.groupBy(parameters, (row) => row.base)) {
    bases.set(base, { base, names: rows.map(({ name }) => name) });
  }
  return bases;
}

/** @param {Block[]} blocks @param {{name: string, priority: number}[]} channels */
function lanesOf(blocks, channels) {
  const lanes = [];
  for (const { name, priority } of channels) {
    const own = blocks.filter(({ channel }) => channel === name);
    if (own.length === 0) continue;
    lanes.push({ channel: name, priority, spans: new Spans(own), ...stacked(own) });
  }
  return lanes;
}

/** @param {Take["speech"]} speech @returns {Speech | null} */
function speechOf(speech) {
  if (!speech) return null;
  return {
    words: new Spans(speech.words),
    phones: new Spans(speech.phones),
    pauses: new Spans(speech.pauses.filter(({ kind }) => kind)),
    tones: new Spans(speech.tones.map((tone) => ({ ...tone, start: tone.time, end: tone.time }))),
    waves: speech.waves,
    loudest: loudestOf(speech.waves[0]?.peaks ?? []),
  };
}

const QUIET = 12; // of 127: quieter sounds are not amplified

/** Return the greatest peak of a sound, by which its outline is normalized. @param {ArrayLike<number>} peaks */
function loudestOf(peaks) {
  return Array.from(peaks).reduce((most, peak) => Math.max(most, Math.abs(peak)), QUIET);
}

/** Return the times that edits snap to: phone boundaries, markers, and the take's ends. @param {Take} take */
function edgesOf({ speech, duration, markers }) {
  const phones = speech?.phones ?? [];
  const marked = markers.map(({ time }) => time);
  const times = new Set([0, duration, ...marked, ...phones.flatMap(({ start, end }) => [start, end])]);
  return Float64Array.from([...times].sort((a, b) => a - b));
}
