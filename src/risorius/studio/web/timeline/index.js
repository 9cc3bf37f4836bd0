/**
 * Show the timeline of a take.
 *
 * @param {HTMLElement} element where it is shown; it fills the element, and may scroll within it
 * @param {object} studio
 * @param {import("../store.js").Store} studio.store
 * @param {import("../connection.js").Connection} studio.connection
 * @param {import("../clock.js").Clock} studio.clock
 * @param {import("../actions.js").Actions} studio.actions
 * @param {HTMLElement} studio.explanation where explanations are shown, beside the stage
 */
export function mountTimeline(element, studio) {
  void element;
  void studio;
}
