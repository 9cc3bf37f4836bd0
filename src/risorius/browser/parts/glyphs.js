/** The page's pictograms, drawn as lines in a square of 24. */

const PATHS = {
  play: '<path class="full" d="M8 5.500v13l10.500-6.500z"/>',
  pause: '<path class="full" d="M7 5.500h3.500v13H7zM13.500 5.500H17v13h-3.500z"/>',
  back: '<path class="full" d="M17 6v12l-8-6z"/><path d="M7 6v12"/>',
  next: '<path class="full" d="M7 6v12l8-6z"/><path d="M17 6v12"/>',
  start: '<path d="M6 6v12M19 6l-9 6 9 6z"/>',
  loop: '<path d="M17 3.500l3 3-3 3M4 11.500v-1a4 4 0 0 1 4-4h12M7 20.500l-3-3 3-3M20 12.500v1a4 4 0 0 1-4 4H4"/>',
  undo: '<path d="M8.500 14.500L4 10l4.500-4.500M4 10h10a5.500 5.500 0 0 1 0 11h-3"/>',
  redo: '<path d="M15.500 14.500L20 10l-4.500-4.500M20 10H10a5.500 5.500 0 0 0 0 11h3"/>',
  theme: '<circle cx="12" cy="12" r="8"/><path class="full" d="M12 4a8 8 0 0 1 0 16z"/>',
  help: '<circle cx="12" cy="12" r="9"/><path d="M9.500 9.500a2.500 2.500 0 1 1 3.500 2.300c-.7.300-1 .8-1 1.700M12 16.500v.01"/>',
  live: '<path d="M12 15a3 3 0 0 0 3-3V7a3 3 0 0 0-6 0v5a3 3 0 0 0 3 3zM6.500 11.500V12a5.500 5.500 0 0 0 11 0v-.500M12 17.500V21"/>',
  lock: '<path d="M8 11V8a4 4 0 0 1 8 0v3"/><path class="full" d="M6 11h12v9H6z"/>',
  full: '<path d="M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5"/>',
  close: '<path d="M6 6l12 12M18 6L6 18"/>',
  sound: '<path d="M4 9.500v5h3.500L12 18V6L7.500 9.500zM15.500 9a4 4 0 0 1 0 6M18 6.500a8 8 0 0 1 0 11"/>',
};

/** @typedef {keyof PATHS} GlyphName */

/** @param {GlyphName} name @returns {SVGElement} */
export function glyph(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("class", "glyph");
  svg.setAttribute("aria-hidden", "true");
  // eslint-disable-next-line no-restricted-properties -- one of the constants above
  svg.innerHTML = PATHS[name];
  return svg;
}
