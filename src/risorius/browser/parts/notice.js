/** A line at the foot of the page that reports an error or a result; it can be closed, and disappears by itself. */

import { button } from "./fields.js";
import { fill, make } from "./dom.js";
import { glyph } from "./glyphs.js";

const STAYS = 8000; // ms
const STAYS_WITH_OFFER = 20_000;

/**
 * @param {HTMLElement} element
 * @returns {(text: string, offer?: {label: string, act: () => void}) => void} shows a line, with an optional button
 */
export function mountNotice(element) {
  let timer = 0;
  const close = () => {
    element.hidden = true;
  };
  return (text, offer) => {
    clearTimeout(timer);
    const closer = button(glyph("close"), { class: "icon", "aria-label": "Close", onclick: close });
    const act = () => {
      close();
      offer?.act();
    };
    fill(element, make("span", {}, text), offer ? button(offer.label, { onclick: act }) : null, closer);
    element.hidden = false;
    timer = setTimeout(close, offer ? STAYS_WITH_OFFER : STAYS);
  };
}
