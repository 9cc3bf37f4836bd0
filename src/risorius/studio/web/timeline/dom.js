import { make, spoken } from "../parts/dom.js";

/**
 * An element as `make` makes it; `style` are properties by name, which need no style attribute.
 * @param {string} tag @param {Record<string, any>} [given] @param {...(Node | string | null | false)} children
 */
export function h(tag, { style = {}, ...given } = {}, ...children) {
  const element = make(tag, given, ...children);
  for (const [name, value] of Object.entries(style)) element.style.setProperty(name, value);
  return element;
}

export { spoken };
