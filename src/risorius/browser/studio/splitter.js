/** The bar between stage and timeline: it moves by pointer and arrow keys, and its place is remembered. */

import { there } from "../parts/dom.js";

const KEY = "risorius-timeline";
const LOWEST = 120; // px of the timeline's height
const LEFT_ABOVE = 260; // px left for the stage
const STEP = 24;

/** @param {HTMLElement} bar */
export function mountSplitter(bar) {
  const timeline = there("timeline");
  const kept = Number(localStorage.getItem(KEY));
  if (kept) set(kept);
  else tell(timeline.clientHeight);
  window.addEventListener("resize", () => tell(timeline.clientHeight));
  bar.addEventListener("pointerdown", (event) => {
    const from = event.clientY + timeline.clientHeight;
    bar.setPointerCapture(event.pointerId);
    /** @param {PointerEvent} moved */
    const move = (moved) => set(from - moved.clientY);
    bar.addEventListener("pointermove", move);
    bar.addEventListener("lostpointercapture", () => bar.removeEventListener("pointermove", move), {
      once: true,
    });
  });
  bar.addEventListener("keydown", (event) => {
    const by = { ArrowUp: STEP, ArrowDown: -STEP }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    set(timeline.clientHeight + by);
  });

  /** @param {number} height */
  function set(height) {
    const now = tell(height);
    document.documentElement.style.setProperty("--timeline-height", `${now}px`);
    localStorage.setItem(KEY, String(now));
  }

  /** Limit a height, tell it to screen readers, and return it. @param {number} height */
  function tell(height) {
    const highest = Math.max(LOWEST, window.innerHeight - LEFT_ABOVE);
    const now = Math.round(Math.min(Math.max(height, LOWEST), highest));
    bar.setAttribute("aria-valuenow", String(now));
    bar.setAttribute("aria-valuemin", String(LOWEST));
    bar.setAttribute("aria-valuemax", String(highest));
    return now;
  }
}
