/** Plays the performance embedded in the page: head, sound, captions, timeline. */

import { Clock } from "./clock.js";
import { buildFigure } from "../stage/figure.js";
import { graphics } from "../stage/graphics.js";
import { Stage } from "../stage/stage.js";
import { rateOf } from "./take.js";
import { followTheme } from "../parts/theme.js";
import { turnByKeys } from "../studio/views.js";
import { block, inflated, woven } from "./data.js";
import { PlayedFaces } from "./faces.js";
import { mountLanes } from "./lanes.js";

/** @param {string} id @returns {any} */
const element = (id) => document.getElementById(id);

const NO_3D = "This browser has no WebGL 2: the head is not drawn.";

followTheme();
/** @type {import("../types.js").PlayedFacts} */
const facts = JSON.parse(new TextDecoder().decode(await inflated("facts")));
const fps = rateOf(facts.fps);
const clock = new Clock();
const stage = graphics() === "none" ? null : new Stage(element("head"), { smooth: graphics() === "card" });
const figure = stage && (await figureOf());
const faces = new PlayedFaces(facts, new Float32Array(await inflated("poses")), () => {
  show();
  clock.begin();
});
if (stage && figure) {
  stage.figures = [figure];
  element("head").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => turnByKeys(event, stage.view));
} else element("note").textContent = NO_3D;
const play = element("play");
play.onclick = () => (clock.playing ? clock.pause() : clock.play());
document.addEventListener("keydown", (event) => {
  if (event.key !== " " || event.target === play) return;
  event.preventDefault();
  play.click();
});
mountLanes(element("timeline"), element("explanation"), facts, clock);
clock.seen = () => !figure || faces.at(frameNow()) !== null;
clock.on("tick", show);
clock.on("state", () => {
  play.textContent = clock.playing ? "Pause" : "Play";
  if (stage) stage.playing = clock.playing;
});
const sound = block("sound");
const address = sound && URL.createObjectURL(new Blob([/** @type {any} */ (sound)], { type: "audio/wav" }));
clock.load({ duration: facts.duration, fps, sound: address });
play.disabled = false;

function frameNow() {
  return Math.min(Math.floor(clock.time * fps + 1e-6), facts.frames - 1);
}

/** The head; the coarse one if there is no graphics card. */
async function figureOf() {
  const [head, shade, folds, skin] = await Promise.all(["head", "shade", "folds", "skin"].map(inflated));
  return buildFigure({ head: woven(head), shade, folds, skin }, facts.stage, graphics() !== "card");
}

function show() {
  if (figure) showFace(figure);
  const cue = facts.captions.find(([, start, end]) => start <= clock.time && clock.time < end);
  const text = cue?.[0] ?? "";
  if (element("caption").textContent !== text) element("caption").textContent = text;
  element("time").value = `${clock.time.toFixed(2)} / ${facts.duration.toFixed(2)} s`;
}

/** @param {import("../stage/figure.js").Figure} shown */
function showFace(shown) {
  const frame = frameNow();
  const a = faces.at(frame);
  if (!a) return;
  const b = faces.at(Math.min(frame + 1, facts.frames - 1)) ?? a;
  element("note").textContent = "";
  const share = Math.min(Math.max(clock.time * fps - frame, 0), 1);
  if (shown.show(a, b, share)) stage?.invalidate();
}

// For tests, and for the browser's console.
window.played = { clock, stage, figure, faces, facts };
