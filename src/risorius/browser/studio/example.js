/** The first minute: an example that plays on a click, then three hints on the parts of the page. */

import { button } from "../parts/fields.js";
import { make } from "../parts/dom.js";
import { playOrPause } from "./playing.js";

const LINE = "Oh really? I would never have thought of that!";
const HINTS = [
  [
    "#timeline",
    "A block is a movement of the face. Click one to see why it is there; drag it to move it, its corners to stretch it.",
  ],
  ["#panel [role=tablist]", "Dials move single muscles, the head, the eyes, or a whole emotion; the face follows at once."],
  ["#explanation", "Why? names the rule behind a movement, the movement that wins at that moment, and those that yield to it."],
];

/** Show a button on the empty stage. @param {HTMLElement} stage @param {import("./studio.js").Studio} studio */
export function mountExample(stage, studio) {
  const { store } = studio;
  const play = button("Play an example", { id: "example", class: "primary", onclick: begin });
  stage.append(play);
  store.watch(["take", "source", "link", "busy", "catalogue"], () => {
    const { script, recording } = store.get("source");
    const empty = store.get("take") === null && script === "" && recording === null;
    play.hidden = !empty || !store.get("catalogue") || store.get("link") !== "up" || store.get("busy") !== "";
  });

  async function begin() {
    store.set({ source: { script: LINE, format: "text", recording: null, edges: [] } });
    await playOrPause(studio);
    if (store.get("take")) showHints();
  }
}

/** Show the hints one after another. */
export function showHints() {
  document.getElementById("hints")?.remove();
  const text = make("p", { role: "status" });
  const next = button("Next", { class: "primary", onclick: () => show(at + 1) });
  const close = button("Close", { onclick: end });
  const card = make("aside", { id: "hints", "aria-label": "Hints" }, text, make("div", { class: "row" }, next, close));
  card.addEventListener("keydown", (event) => event.key === "Escape" && end());
  let at = -1;
  document.body.append(card);
  show(0);
  next.focus();

  /** @param {number} number */
  function show(number) {
    mark(at, false);
    if (number >= HINTS.length) {
      end();
      return;
    }
    at = number;
    const target = /** @type {Element} */ (mark(at, true));
    text.textContent = `${at + 1} of ${HINTS.length}: ${HINTS[at][1]}`;
    next.hidden = at === HINTS.length - 1;
    if (next.hidden) close.focus();
    target.scrollIntoView({ block: "nearest" });
    place(card, target.getBoundingClientRect());
  }

  /** @param {number} number @param {boolean} on */
  function mark(number, on) {
    const target = HINTS[number] && document.querySelector(HINTS[number][0]);
    target?.toggleAttribute("data-hinted", on);
    return target;
  }

  function end() {
    mark(at, false);
    card.remove();
  }
}

/** Place a card beside the part that it describes, within the window. @param {HTMLElement} card @param {DOMRect} box */
function place(card, { left, top, bottom }) {
  const { offsetWidth: width, offsetHeight: height } = card;
  const above = top - height - 8;
  const y = above > 0 ? above : Math.min(bottom + 8, innerHeight - height - 8);
  card.style.left = `${Math.max(8, Math.min(left + 8, innerWidth - width - 8))}px`;
  card.style.top = `${Math.max(8, y)}px`;
}
