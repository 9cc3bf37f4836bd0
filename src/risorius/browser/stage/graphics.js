/** How this browser draws 3D: with a graphics card, with the processor, or not at all. */

/**
 * @typedef {"card" | "coarse" | "processor" | "none"} Graphics `coarse`: as for "card", but the coarse head; only where the
 *   page's address asks for it
 */

// Names that browsers give to renderers without a graphics card. Firefox and Chrome on Windows have WARP, "Microsoft Basic
// Render Driver".
const BY_PROCESSOR = /swiftshader|llvmpipe|softpipe|swrast|\bswr\b|basic render|\bwarp\b|software/i;

/** @type {Graphics[]} */
const WAYS = ["card", "coarse", "processor", "none"];
/** @type {Graphics | null} */
let known = null;

/**
 * @param {Object} found
 * @param {boolean} found.webgl whether there is WebGL 2
 * @param {boolean} found.quick whether there is one that the browser does not report as slow
 * @param {string} found.renderer its name; "" if the browser hides it
 * @returns {Graphics}
 */
export function graphicsOf({ webgl, quick, renderer }) {
  if (!webgl) return "none";
  return quick && !BY_PROCESSOR.test(renderer) ? "card" : "processor";
}

/**
 * Return how this page draws. `?graphics=card`, `coarse`, `processor` or `none` in its address overrides detection.
 * @returns {Graphics}
 */
export function graphics() {
  known ??= asked(location.search) ?? graphicsOf(probed());
  return known;
}

/** Return the choice in an address, or null. @param {string} search @returns {Graphics | null} */
export function asked(search) {
  const wanted = new URLSearchParams(search).get("graphics");
  return WAYS.find((way) => way === wanted) ?? null;
}

function probed() {
  const [quick, any] = [true, false].map(contextOf);
  const context = quick ?? any;
  // Some browsers mask the name, others give it without the extension.
  const about = context?.getExtension("WEBGL_debug_renderer_info");
  const renderer = context?.getParameter(about ? about.UNMASKED_RENDERER_WEBGL : context.RENDERER) ?? "";
  for (const one of [quick, any]) one?.getExtension("WEBGL_lose_context")?.loseContext();
  return { webgl: context !== null, quick: quick !== null, renderer: String(renderer) };
}

/** @param {boolean} failIfMajorPerformanceCaveat */
function contextOf(failIfMajorPerformanceCaveat) {
  return document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat });
}
