/**
 * Keys of the timeline that need no block in focus; they reach only what the timeline itself does not use.
 */

const ZOOM = 1.4;

/** @param {HTMLElement} root @param {import("./desk.js").Desk} desk @param {() => void} add */
export function shortcuts(root, desk, add) {
  const keys = {
    "+": () => desk.zoom(ZOOM),
    "=": () => desk.zoom(ZOOM),
    "-": () => desk.zoom(1 / ZOOM),
    n: () => add(),
    d: () => root.querySelector("#tl-draw").click(),
    Delete: () => desk.remove(),
    Backspace: () => desk.remove(),
  };
  root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || typing(event.target)) return;
    const act = keys[event.key];
    if (!act || !desk.scene.model) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  });
}

function typing({ tagName, type }) {
  return tagName === "TEXTAREA" || tagName === "SELECT" || (tagName === "INPUT" && type !== "checkbox");
}
