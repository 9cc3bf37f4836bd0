/** The timeline of the page: words and movements by channel; a click goes there and shows the explanation. */

import { fill, make, spoken } from "../parts/dom.js";
/** @import {PlayedBlock, PlayedFacts} from "../types.js" */

/**
 * @param {HTMLElement} element @param {HTMLElement} why element for the explanations
 * @param {PlayedFacts} facts of the page @param {import("./clock.js").Clock} clock
 */
export function mountLanes(element, why, facts, clock) {
  /** @param {string} name @param {PlayedBlock[]} blocks */
  const track = (name, blocks) => lane(name, blocks, facts.duration);
  const words = facts.words.map(([text, start, end]) => ({ text, start, end, kind: "word" }));
  const lanes = facts.lanes.map(({ channel, blocks }) => {
    return track(channel, blocks.map(([text, start, end, rule, targets]) => ({ text, start, end, rule, targets })));
  });
  const head = make("div");
  const tracks = [...(words.length ? [track("words", words)] : []), ...lanes];
  const inner = make("div", { style: "position: relative; min-height: 100%" });
  inner.append(...tracks, make("div", { id: "playhead" }, head));
  element.append(inner);
  clock.on("tick", () => {
    head.style.transform = `translateX(${(100 * clock.time) / facts.duration}%)`;
  });
  element.addEventListener("click", (event) => {
    const { left, right } = /** @type {HTMLElement} */ (head.parentElement).getBoundingClientRect();
    if (event.clientX < left) return;
    const time = ((event.clientX - left) / (right - left)) * facts.duration;
    clock.pause();
    clock.seek(time);
    element.querySelector(".chosen")?.classList.remove("chosen");
    const target = /** @type {Element} */ (event.target);
    const chosen = /** @type {(Element & {block?: PlayedBlock}) | null} */ (target.closest(".block"));
    chosen?.classList.add("chosen");
    explain(why, facts, time, chosen?.block ?? null);
  });
}

/** @param {string} name @param {PlayedBlock[]} blocks @param {number} duration */
function lane(name, blocks, duration) {
  /** @type {number[]} */
  const ends = [];
  const made = blocks.toSorted((a, b) => a.start - b.start).map((block) => {
    let row = ends.findIndex((end) => end <= block.start);
    if (row < 0) row = ends.push(0) - 1;
    ends[row] = block.end;
    const style = `left: ${(100 * block.start) / duration}%; width: ${(100 * (block.end - block.start)) / duration}%; top: ${1.25 * row}rem`;
    const element = make("div", { class: `block ${block.kind ?? ""}`, style, title: block.text }, block.text);
    return Object.assign(element, { block });
  });
  const track = make("div", { class: "track", style: `--rows: ${ends.length}` }, ...made);
  return make("div", { class: "lane" }, make("h2", {}, name), track);
}

/** @param {HTMLElement} why @param {PlayedFacts} facts @param {number} time @param {PlayedBlock | null} block */
function explain(why, facts, time, block) {
  const { lines, times } = facts.reasons;
  const row = Math.min(Math.round(time / facts.every), times.length - 1);
  const text = times[row].map((number) => lines[number]).join("\n");
  fill(why, make("h2", {}, `At ${(row * facts.every).toFixed(1)} s`), block?.targets ? of(block) : null, make("pre", {}, text));
}

/** @param {PlayedBlock} block */
function of({ text, start, end, rule, targets = {} }) {
  const moved = Object.entries(targets).map(([name, value]) => `${spoken(name)} ${value.toFixed(2)}`);
  return make("p", {}, make("b", {}, text), ` ${start.toFixed(2)} to ${end.toFixed(2)} s, by ${rule}: ${moved.join(", ")}`);
}
