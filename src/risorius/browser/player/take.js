/**
 * A take in the page: the wire's `TakeView` with its numbers decoded.
 *
 * `curves` are Float32Array by parameter (parameters at rest throughout are left out), `rate` is frames per second
 * as a number, `waves[].peaks` are Int8Array (least, greatest, least, …). All else is as in the wire.
 */

/** @import {SpeechView} from "../wire.js" */
/** @import {Written} from "../types.js" */

/** @param {string} text base64 @returns {Uint8Array} */
export function bytesOf(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; k++) bytes[k] = binary.charCodeAt(k);
  return bytes;
}

/** @param {string} text base64 of little-endian float32 @returns {Float32Array} */
export function floatsOf(text) {
  return new Float32Array(bytesOf(text).buffer);
}

/** @param {string} fps such as "24000/1001" @returns {number} */
export function rateOf(fps) {
  const [over, under = "1"] = fps.split("/");
  return Number(over) / Number(under);
}

/** @param {import("../wire.js").TakeView} view */
export function takeOf(view) {
  return { ...view, rate: rateOf(view.fps), curves: decoded(view.curves), speech: heard(view.speech), made: whole(view.made) };
}

/**
 * Return the take after a change: a new object that shares the unchanged parts.
 * @param {ReturnType<typeof takeOf>} take @param {import("../wire.js").TakeChange} change
 */
export function changedTake(take, change) {
  if (change.whole) return takeOf(change.whole);
  const gone = new Set([...change.gone, ...change.blocks.map((block) => block.id)]);
  const blocks = [...take.blocks.filter((block) => !gone.has(block.id)), ...change.blocks];
  blocks.sort((a, b) => a.start - b.start);
  const curves = { ...take.curves, ...decoded(change.curves) };
  for (const [name, text] of Object.entries(change.curves)) if (text === "") delete curves[name];
  const made = whole(change.made);
  const { drawn, undoes, redoes, warnings, lost, markers, lanes } = change;
  return {
    ...take,
    take: change.take,
    blocks,
    curves,
    drawn,
    made,
    undoes,
    redoes,
    warnings,
    lost,
    markers,
    lanes,
  };
}

/** Decode the curves of an answer; null for a parameter that is now at rest. @param {Record<string, string>} curves */
export function curvesOf(curves) {
  return new Map(Object.entries(curves).map(([name, text]) => [name, text === "" ? null : floatsOf(text)]));
}

/** Return the source and settings that a take was made from; the server sends all of them. @param {import("../wire.js").TakeInputs} made */
function whole(made) {
  return /** @type {Written} */ (made);
}

/** @param {Record<string, string>} curves */
function decoded(curves) {
  return Object.fromEntries(Object.entries(curves).map(([name, text]) => [name, floatsOf(text)]));
}

/** @param {SpeechView | null} speech */
function heard(speech) {
  if (speech === null) return null;
  const waves = speech.waves.map((wave) => ({ ...wave, peaks: new Int8Array(bytesOf(wave.peaks).buffer) }));
  return { ...speech, waves };
}
