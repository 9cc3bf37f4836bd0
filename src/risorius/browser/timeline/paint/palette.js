/**
 * The current colours of the page's style sheet: a canvas cannot use CSS variables.
 */

/** @import {Palette, ColourName} from "../../types.js" */

const NAMES = [
  "ground", "head", "rule", "grid", "text", "faint", "wave", "word", "pause", "accent", "tone",
  "mark", "loop", "curve", "other", "inhibited", "limited", "key", "label",
]; // prettier-ignore

/** @param {Element} element within the timeline @param {string[]} channels @returns {Palette} colours by name, those of channels apart */
export function paletteOf(element, channels) {
  const style = getComputedStyle(element);
  /** @param {string} name */
  const colour = (name) => style.getPropertyValue(`--tl-${name}`).trim();
  const named = /** @type {Record<ColourName, string>} */ (Object.fromEntries(NAMES.map((name) => [name, colour(name)])));
  return {
    ...named,
    channels: Object.fromEntries(channels.map((name) => [name, colour(`channel-${name}`) || colour("mark")])),
    font: style.fontFamily,
  };
}

/** Call `call` when the theme changes. @param {() => void} call @returns {() => void} ends it */
export function onTheme(call) {
  const watcher = new MutationObserver(call);
  watcher.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme", "class", "style"] });
  const media = ["(prefers-color-scheme: dark)", "(forced-colors: active)"].map((query) => matchMedia(query));
  for (const one of media) one.addEventListener("change", call);
  return () => {
    watcher.disconnect();
    for (const one of media) one.removeEventListener("change", call);
  };
}
