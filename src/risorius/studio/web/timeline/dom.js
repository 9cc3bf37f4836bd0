/**
 * An element with its attributes, listeners (`onclick` …) and children.
 * @param {string} tag @param {Record<string, any>} [given] @param {...(Node | string | null)} children
 */
export function h(tag, given = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(given)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "style") for (const [key, text] of Object.entries(value)) element.style.setProperty(key, text);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** A name as it is read: "zygomatic_major.left" as "zygomatic major, left". */
export function spoken(name) {
  return name.replaceAll("_", " ").replace(".", ", ");
}
