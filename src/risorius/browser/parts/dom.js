/** Small helpers to make elements. */

/** @import {Attributes, Child} from "../types.js" */

/**
 * Make an element.
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Attributes} [given] attributes; `onclick` and the like are listeners, `class` is the class,
 *   false, null and undefined are left out; `value`, `checked` and `disabled` are set as properties
 * @param {...Child} children
 * @returns {HTMLElementTagNameMap[T]}
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
  for (const name of PROPERTIES) if (given[name] !== undefined) Reflect.set(element, name, given[name]);
  return element;
}
const PROPERTIES = new Set(["value", "checked", "disabled", "hidden", "indeterminate"]);

/** Return the canvas's 2D context, which every browser has. @param {HTMLCanvasElement} canvas @param {CanvasRenderingContext2DSettings} [settings] */
export function contextOf(canvas, settings) {
  return /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", settings));
}

/** Return an element that the page always has. @template {HTMLElement} [T=HTMLElement] @param {string} id @returns {T} */
export function there(id) {
  return /** @type {T} */ (document.getElementById(id));
}

/** Return the first element within another that matches a selector, or null. @param {Element} within @param {string} selector */
export function foundIn(within, selector) {
  return /** @type {HTMLElement | null} */ (within.querySelector(selector));
}

/** Return the message of a thrown value. @param {unknown} error @returns {string} */
export function told(error) {
  return error instanceof Error ? error.message : String(error);
}

let names = 0;
/** @returns {string} an id that no other element has */
export function fresh(prefix = "e") {
  names += 1;
  return `${prefix}-${names}`;
}

/** Replace an element's children. @template {HTMLElement} E @param {E} element @param {...Child} children */
export function fill(element, ...children) {
  element.replaceChildren(...children.filter((child) => child !== null && child !== false));
  return element;
}

/**
 * Return a function that calls `call` once it has not been called itself for `wait` ms (debounce).
 * @template {unknown[]} A @param {(...given: A) => void} call @param {number} wait
 */
export function settled(call, wait) {
  let timer = 0;
  return (/** @type {A} */ ...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => call(...given), wait);
  };
}

/**
 * Show the rows of a list that pass a test, and the groups that contain one.
 * @param {HTMLElement} list of groups @param {string} row selector of the rows
 * @param {(row: HTMLElement) => boolean} wanted
 */
export function showFound(list, row, wanted) {
  for (const one of /** @type {NodeListOf<HTMLElement>} */ (list.querySelectorAll(row))) one.hidden = !wanted(one);
  const groups = /** @type {Iterable<HTMLElement>} */ (list.children);
  for (const group of groups) group.hidden = !group.querySelector(`${row}:not([hidden])`);
}

/** @param {string} name e.g. "zygomatic_major.left" @returns {string} as people read it */
export function spoken(name) {
  return name.replace(/[._]/g, " ");
}
