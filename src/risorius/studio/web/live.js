/** The live face: what is typed is said at once, in the voice and on the head that are chosen. */

import { button } from "./parts/fields.js";
import { make, there } from "./parts/dom.js";
import { glyph } from "./parts/glyphs.js";

/**
 * Return the button that puts a live face over the stage, and takes it away.
 * @param {import("./studio.js").Studio} studio
 * @returns {HTMLElement}
 */
export function liveSwitch({ store, clock }) {
  let frame = null;
  const label = "Live: type, and it speaks";
  const act = () => {
    if (frame) frame.remove();
    frame = frame ? null : shown(store);
    if (frame) {
      clock.pause();
      there("stage").append(frame);
      frame.addEventListener("load", () => {
        const { documentElement: root } = frame.contentDocument;
        root.style.colorScheme = getComputedStyle(document.documentElement).colorScheme;
        frame.contentDocument.getElementById("text").focus();
      });
    }
    live.setAttribute("aria-pressed", String(frame !== null));
  };
  const about = { class: "plain icon", id: "live", "aria-label": label, "aria-pressed": "false", title: label };
  const live = button(glyph("live"), { ...about, onclick: act });
  return live;
}

/** The page of the live face, with what is chosen otherwise than usual. */
function shown(store) {
  const usual = store.get("catalogue").choices;
  const chosen = Object.entries(store.get("choices")).filter(
    ([name, value]) => JSON.stringify(value) !== JSON.stringify(usual[name]),
  );
  const settings = JSON.stringify(Object.fromEntries(chosen));
  return make("iframe", {
    id: "live-face",
    title: "A live face",
    allow: "autoplay; microphone",
    src: `/live/?embedded#${new URLSearchParams({ settings })}`,
  });
}
