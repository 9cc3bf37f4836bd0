/** A line at the foot of the page for what went wrong or was done; it can be closed, and goes by itself. */

import { button } from "./fields.js";
import { fill, make } from "./dom.js";
import { glyph } from "./glyphs.js";

const STAYS = 8000; // ms

/** @param {HTMLElement} element @returns {(text: string) => void} says a line */
export function mountNotice(element) {
  let timer = 0;
  const close = () => {
    element.hidden = true;
  };
  return (text) => {
    clearTimeout(timer);
    const closer = button(glyph("close"), { class: "icon", "aria-label": "Close", onclick: close });
    fill(element, make("span", {}, text), closer);
    element.hidden = false;
    timer = setTimeout(close, STAYS);
  };
}
