/**
 * The head of the timeline: ruler, the sound's outline, words, phones, accents and tones, pauses.
 */

/** @import {Outline, Palette, Speech, SpeechRow} from "../../types.js" */
/** @import {PhoneView, WordView} from "../../wire.js" */
/** @import {Scene} from "./scene.js" */
/** @import {Model} from "../model/model.js" */

const STEPS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300];
const LABEL_ROOM = 64; // pixels between labels of the ruler

/** @param {Scene} scene @param {SpeechRow} row */
export function paintRuler({ context, view, palette, width, count, loop }, row) {
  if (loop) {
    context.fillStyle = palette.loop;
    context.fillRect(view.x(loop[0]), row.y, Math.max(view.x(loop[1]) - view.x(loop[0]), 1), row.height);
  }
  const step = STEPS.find((s) => s * view.scale >= LABEL_ROOM) ?? STEPS[STEPS.length - 1];
  const minor = step / 5;
  const bottom = row.y + row.height;
  context.fillStyle = palette.rule;
  for (let k = Math.max(0, Math.floor(view.start / minor)); k * minor <= Math.min(view.end, view.duration); k++) {
    const x = Math.round(view.x(k * minor));
    const tall = k % 5 === 0;
    context.fillRect(x, bottom - (tall ? 8 : 4), 1, tall ? 8 : 4);
    count.marks++;
    if (tall && x < width) label(context, clockTime(k * minor, step), x + 3, row.y + 9, palette);
  }
}

/**
 * @param {CanvasRenderingContext2D} context @param {string} text @param {number} x @param {number} y
 * @param {Palette} palette
 */
function label(context, text, x, y, palette) {
  context.fillStyle = palette.faint;
  context.font = `10px ${palette.font}`;
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillText(text, x, y);
  context.fillStyle = palette.rule;
}

/** Format seconds as 1:02.50, with the decimals that a step needs. @param {number} time */
export function clockTime(time, step = 0.001) {
  const places = step >= 1 ? 0 : step >= 0.1 ? 1 : step >= 0.01 ? 2 : 3;
  const minutes = Math.floor(time / 60);
  const seconds = (time - 60 * minutes).toFixed(places);
  return minutes ? `${minutes}:${seconds.padStart(places ? places + 3 : 2, "0")}` : seconds;
}

/**
 * Draw the sound's outline, from the coarsest zoom that is fine enough; pauses behind it, accents above.
 * @param {Scene} scene @param {SpeechRow} row
 */
export function paintWave(scene, row) {
  const { context, view, model, palette } = scene;
  paintPauses(scene, row);
  const { waves } = speechOf(model);
  const wave = waves.find((w) => w.seconds_per_bucket * view.scale <= 1) ?? waves.at(-1);
  if (wave) outline(scene, row, wave);
  context.fillStyle = palette.grid;
  context.fillRect(0, row.y + row.height / 2, scene.width, 1);
  paintTones(scene, row);
}

/** @param {Scene} scene @param {SpeechRow} row @param {Outline} wave */
function outline({ context, view, palette, width, count, model }, row, { peaks, seconds_per_bucket: size }) {
  const middle = row.y + row.height / 2;
  const scale = (row.height / 2 - 1) / speechOf(model).loudest;
  const left = Math.max(0, view.x(0));
  const right = Math.min(width, view.x(model.duration));
  context.fillStyle = palette.wave;
  for (let x = Math.floor(left + 1e-6); x < right; x++) {
    const first = Math.max(0, Math.floor(view.time(x) / size));
    const last = Math.min(peaks.length / 2, Math.max(first + 1, Math.ceil(view.time(x + 1) / size)));
    let [low, high] = [0, 0];
    for (let k = first; k < last; k++) {
      low = Math.min(low, peaks[2 * k]);
      high = Math.max(high, peaks[2 * k + 1]);
    }
    context.fillRect(x, middle - high * scale, 1, Math.max((high - low) * scale, 1));
    count.columns++;
  }
}

/** @param {Scene} scene @param {SpeechRow} row */
function paintPauses({ context, view, model, palette, count }, row) {
  context.font = `italic 10px ${palette.font}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const pause of speechOf(model).pauses.within(view.start, view.end)) {
    const [x, end] = [view.x(pause.start), view.x(pause.end)];
    context.fillStyle = palette.pause;
    context.fillRect(x, row.y, Math.max(end - x, 1), row.height);
    count.marks++;
    const text = pause.kind.replaceAll("_", " ");
    if (context.measureText(text).width + 6 > end - x) continue;
    context.fillStyle = palette.faint;
    context.fillText(text, (x + end) / 2, row.y + row.height - 7);
  }
}

/** Return the speech if its rows are drawn. @param {Model} model */
function speechOf(model) {
  return /** @type {Speech} */ (model.speech);
}

const TONE_GAP = 3;
const SPARSE = 20; // pixels a second: closer, they would hide the sound

/**
 * Accents as marks over their vowels, a phrase's last tones as flags; nuclear ones filled.
 * @param {Scene} scene @param {SpeechRow} row
 */
function paintTones({ context, view, model, palette, count }, row) {
  if (view.scale < SPARSE) return;
  let free = -Infinity;
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (const tone of speechOf(model).tones.within(view.start, view.end)) {
    const x = Math.round(view.x(tone.time));
    const colour = tone.accent ? palette.accent : palette.tone;
    context.fillStyle = colour;
    context.fillRect(x, row.y + 1, 1, tone.accent ? 10 : row.height - 1);
    count.marks++;
    context.font = `${tone.nuclear ? "bold " : ""}10px ${palette.font}`;
    const wide = context.measureText(tone.label).width;
    const left = tone.accent ? x + TONE_GAP : x - TONE_GAP - wide;
    if (left < free) continue;
    context.fillText(tone.label, left, row.y + 7);
    free = left + wide + TONE_GAP;
  }
}

const NARROW = 7; // pixels in which no text fits

/** Draw words or phones: a box each, with its text if it fits. @param {Scene} scene @param {SpeechRow} row */
export function paintTexts({ context, view, palette, model, count }, row) {
  const words = row.kind === "words";
  const speech = speechOf(model);
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.font = `${words ? 12 : 10}px ${palette.font}`;
  let painted = -Infinity;
  for (const item of (words ? speech.words : speech.phones).within(view.start, view.end)) {
    const [x, end] = [view.x(item.start), view.x(item.end)];
    if (end - painted < 1) continue; // within one pixel of the last box
    painted = end;
    count.texts++;
    paintText({ context, palette, view }, row, item, [x, end]);
  }
}

/**
 * @param {Pick<Scene, "context" | "palette" | "view">} scene @param {SpeechRow} row
 * @param {WordView | PhoneView} item @param {[x: number, end: number]} span
 */
function paintText({ context, palette, view }, row, item, [x, end]) {
  const text = textOf(item);
  if (!text) return;
  context.fillStyle = palette.word;
  context.fillRect(x + 0.5, row.y + 1, Math.max(end - x - 1, 0.5), row.height - 2);
  const [left, right] = [Math.max(x, 0), Math.min(end, view.width)];
  const room = right - left;
  if (room < NARROW) return;
  const y = row.y + row.height / 2 + 0.5;
  context.fillStyle = palette.text;
  const shown = "text" in item ? beginning(context, text, room - 2) : text;
  if (context.measureText(shown).width <= room) context.fillText(shown, (left + right) / 2, y);
}

/** Return the text of a word or the symbol of a phone. @param {WordView | PhoneView} item */
export function textOf(item) {
  return "text" in item ? item.text : item.symbol;
}

/**
 * Return a text, shortened to the available width; "" if only one letter would fit.
 * @param {CanvasRenderingContext2D} context @param {string} text @param {number} room
 */
export function beginning(context, text, room) {
  if (context.measureText(text).width <= room) return text;
  const letters = [...text];
  while (letters.length > 1 && context.measureText(`${letters.join("")}…`).width > room) letters.pop();
  return letters.length > 1 ? `${letters.join("")}…` : "";
}
