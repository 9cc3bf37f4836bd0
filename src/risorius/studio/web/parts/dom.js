/** Small helpers to make elements. */

/**
 * Make an element.
 * @param {string} tag
 * @param {Record<string, any>} [given] attributes; `onclick` and the like are listeners, `class` is the class,
 *   what is false, null or undefined is left out; `value`, `checked`, `disabled` are set as properties
 * @param {...(Node | string | null | false)} children
 * @returns {any}
 */
export function make(tag, given = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(given)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (PROPERTIES.has(name)) continue;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null && child !== false));
  for (const name of PROPERTIES) if (given[name] !== undefined) element[name] = given[name];
  return element;
}
const PROPERTIES = new Set(["value", "checked", "disabled", "hidden", "indeterminate"]);

/** The canvas' pen: every browser has one. @param {HTMLCanvasElement} canvas @param {CanvasRenderingContext2DSettings} [settings] */
export function contextOf(canvas, settings) {
  return /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", settings));
}

/** An element that the page is known to have. @param {string} id @returns {any} */
export function there(id) {
  return document.getElementById(id);
}

/** What was thrown, in a line. @param {unknown} error @returns {string} */
export function told(error) {
  return error instanceof Error ? error.message : String(error);
}

let names = 0;
/** @returns {string} an id that no other element has */
export function fresh(prefix = "e") {
  names += 1;
  return `${prefix}-${names}`;
}

/** Put other children into an element. */
export function fill(element, ...children) {
  element.replaceChildren(...children.filter((child) => child !== null && child !== false));
  return element;
}

/** Call at most once per animation frame, with the last arguments. */
export function perFrame(call) {
  let last = null;
  return (...given) => {
    if (last === null) {
      requestAnimationFrame(() => {
        const now = last;
        last = null;
        call(...now);
      });
    }
    last = given;
  };
}

/** Call when nothing new has come for `wait` ms. */
export function settled(call, wait) {
  let timer = 0;
  return (...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => call(...given), wait);
  };
}

/** @param {string} name e.g. "zygomatic_major.left" @returns {string} as people read it */
export function spoken(name) {
  return name.replace(/[._]/g, " ");
}
