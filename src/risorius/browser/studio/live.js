/** The live face: it speaks typed text at once, with the chosen voice and head. */

import { button } from "../parts/fields.js";
import { make, there } from "../parts/dom.js";
import { glyph } from "../parts/glyphs.js";
import { asked } from "../stage/graphics.js";
/** @import {Store} from "./store.js" */

/**
 * Return the button that shows a live face over the stage, and removes it.
 * @param {import("./studio.js").Studio} studio
 * @returns {HTMLElement}
 */
export function liveSwitch({ store, clock }) {
  /** @type {HTMLIFrameElement | null} */
  let frame = null;
  const label = "Live: type, and it speaks";
  const act = () => {
    const now = frame ? null : shown(store);
    frame?.remove();
    frame = now;
    if (now) {
      clock.pause();
      there("stage").append(now);
      now.addEventListener("load", () => {
        const page = /** @type {Document} */ (now.contentDocument);
        const { documentElement: root } = page;
        root.style.colorScheme = getComputedStyle(document.documentElement).colorScheme;
        page.getElementById("text")?.focus();
      });
    }
    live.setAttribute("aria-pressed", String(frame !== null));
  };
  const about = { class: "plain icon", id: "live", "aria-label": label, "aria-pressed": "false", title: label };
  const live = button(glyph("live"), { ...about, onclick: act });
  return live;
}

/** Return the address of the live face's page, with the settings that differ from their defaults. @param {Store} store */
function shown(store) {
  /** @type {Record<string, unknown>} */
  const usual = { ...store.get("catalogue").choices };
  const chosen = Object.entries(store.get("choices")).filter(
    ([name, value]) => JSON.stringify(value) !== JSON.stringify(usual[name]),
  );
  const settings = JSON.stringify(Object.fromEntries(chosen));
  const way = asked(location.search);
  return make("iframe", {
    id: "live-face",
    title: "A live face",
    allow: "autoplay; microphone",
    src: `/live/?embedded${way ? `&graphics=${way}` : ""}#${new URLSearchParams({ settings })}`,
  });
}
