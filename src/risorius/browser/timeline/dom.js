import { foundIn, make, spoken } from "../parts/dom.js";
/** @import {Attributes, Child} from "../types.js" */

/**
 * Make an element like `make`; `style` sets style properties by name, without a style attribute.
 * @template {keyof HTMLElementTagNameMap} T @param {T} tag @param {Attributes} [given] @param {...Child} children
 */
export function h(tag, { style = {}, ...given } = {}, ...children) {
  const element = make(tag, given, ...children);
  for (const [name, value] of Object.entries(style)) element.style.setProperty(name, value);
  return element;
}

export { foundIn, spoken };
