/** The playback slider. */

import { make } from "./dom.js";

/**
 * The browser's own slider serves pointers, keys and screen readers, but is invisible: without a graphics card,
 * redrawing it takes as long as drawing the head. The visible parts are only moved.
 * @param {string} label @param {(value: number) => void} input receives the value that the user chooses
 * @returns {HTMLElement & {show: (value: number, most: number, told: string) => void}}
 */
export function scrubber(label, input) {
  const slider = make("input", { type: "range", class: "scrub", min: 0, step: "any", "aria-label": label });
  slider.addEventListener("input", () => input(Number(slider.value)));
  const filled = make("div", { class: "scrub-filled" });
  const thumb = make("div", { class: "scrub-thumb" }, make("div"));
  const element = make("div", { class: "scrubber" }, make("div", { class: "scrub-track" }, filled), thumb, slider);
  return Object.assign(element, {
    /** @param {number} value @param {number} most @param {string} told */
    show(value, most, told) {
      slider.max = String(most);
      slider.value = String(value);
      slider.setAttribute("aria-valuetext", told);
      const share = most > 0 ? value / most : 0;
      filled.style.transform = `scaleX(${share})`;
      thumb.style.transform = `translateX(${100 * share}%)`;
    },
  });
}
