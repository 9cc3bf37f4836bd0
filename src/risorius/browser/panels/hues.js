/** A hue for each emotion, so that it looks the same wherever it is marked: they are spread over the circle. */

/** @param {import("../wire.js").Catalogue | null} catalogue @param {string} emotion @returns {number} degrees */
export function hueOf(catalogue, emotion) {
  const names = catalogue?.emotions.map(({ name }) => name) ?? [];
  return Math.round((360 * Math.max(0, names.indexOf(emotion))) / Math.max(1, names.length)) + 20;
}
