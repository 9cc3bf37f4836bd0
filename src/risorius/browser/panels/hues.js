/** A hue for each emotion, spread over the colour circle; an emotion has the same hue everywhere. */

/** @param {import("../wire.js").Catalogue | null} catalogue @param {string} emotion @returns {number} degrees */
export function hueOf(catalogue, emotion) {
  const names = catalogue?.emotions.map(({ name }) => name) ?? [];
  return Math.round((360 * Math.max(0, names.indexOf(emotion))) / Math.max(1, names.length)) + 20;
}
