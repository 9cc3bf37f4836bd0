/** Playback controls: play and pause, steps, position, speed, loop. */

import { glyph } from "../parts/glyphs.js";
import { canPlay, playOrPause } from "./playing.js";
import { button } from "../parts/fields.js";
import { fill, make } from "../parts/dom.js";
import { scrubber } from "../parts/scrubber.js";
/** @import {Clock} from "../player/clock.js" */
/** @import {GlyphName} from "../parts/glyphs.js" */

const SPEEDS = [0.1, 0.25, 0.5, 0.75, 1, 1.5];

/** @param {HTMLElement} element @param {import("./studio.js").Studio} studio */
export function mountTransport(element, studio) {
  const { clock, store } = studio;
  const play = button(glyph("play"), {
    class: "primary icon",
    id: "play",
    onclick: () => playOrPause(studio),
  });
  /** @param {GlyphName} name @param {string} label @param {string} key @param {() => void} act */
  const icon = (name, label, key, act) =>
    button(glyph(name), {
      class: "plain icon",
      "aria-label": label,
      title: `${label} (${key})`,
      onclick: act,
    });
  const place = scrubber("Playhead", (value) => clock.seek(value));
  const time = make("output", { class: "time", id: "time" });
  const loop = icon("loop", "Loop", "L", () => toggleLoop(clock));
  const speed = make(
    "select",
    { "aria-label": "Speed", onchange: () => clock.setRate(Number(speed.value)) },
    ...SPEEDS.map((rate) => make("option", { value: String(rate) }, `${rate} ×`)),
  );
  element.append(
    icon("start", "To the start", "Home", () => clock.seek(0)),
    icon("back", "One frame back", "←", () => clock.step(-1)),
    play,
    icon("next", "One frame forward", "→", () => clock.step(1)),
    time,
    place,
    loop,
    speed,
  );
  clock.on("tick", showTime);
  clock.on("state", showState);
  store.watch(["take", "source", "link"], () => {
    play.disabled = !canPlay(store);
  });
  showTime();
  showState();

  function showTime() {
    const frame = Math.round(clock.time * clock.fps);
    place.show(clock.time, clock.duration, `${clock.time.toFixed(2)} seconds`);
    time.value = `${stamp(clock.time)} / ${stamp(clock.duration)} · ${frame}`;
    const last = `${stamp(clock.duration)} / ${stamp(clock.duration)} · ${Math.round(clock.duration * clock.fps)}`;
    // Its maximum width, so that the scrubber beside it does not move during playback.
    time.style.minWidth = `${last.length}ch`;
    time.title = `frame ${frame} of ${Math.round(clock.duration * clock.fps)}`;
  }

  function showState() {
    fill(play, glyph(clock.playing ? "pause" : "play"));
    const label = clock.playing ? "Pause" : "Play";
    play.setAttribute("aria-label", label);
    play.title = `${label} (space)`;
    loop.setAttribute("aria-pressed", String(clock.loop !== null));
    speed.value = String(clock.rate);
    showTime();
  }
}

/** Turn looping of the whole take on or off. @param {Clock} clock */
export function toggleLoop(clock) {
  clock.setLoop(clock.loop ? null : [0, clock.duration]);
}

/** @param {number} time seconds @returns {string} such as 0:03.250 */
function stamp(time) {
  const minutes = Math.floor(time / 60);
  const seconds = time - 60 * minutes;
  return `${minutes}:${seconds.toFixed(2).padStart(5, "0")}`;
}
