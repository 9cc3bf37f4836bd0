/** How this browser draws in 3D: by a graphics card, by the processor, or not at all. */

/**
 * @typedef {"card" | "coarse" | "processor" | "none"} Graphics `coarse`: as for "card", but the coarse head; only where the
 *   page's address asks for it
 */

// Renderers that draw by the processor, as the browser names them. Firefox and Chrome on Windows have WARP, "Microsoft Basic
// Render Driver".
const BY_PROCESSOR = /swiftshader|llvmpipe|softpipe|swrast|\bswr\b|basic render|\bwarp\b|software/i;

/** @type {Graphics[]} */
const WAYS = ["card", "coarse", "processor", "none"];
/** @type {Graphics | null} */
let known = null;

/**
 * @param {Object} found
 * @param {boolean} found.webgl whether there is WebGL 2
 * @param {boolean} found.quick whether there is one of which the browser itself does not say that it is slow
 * @param {string} found.renderer its name; "" where the browser does not tell
 * @returns {Graphics}
 */
export function graphicsOf({ webgl, quick, renderer }) {
  if (!webgl) return "none";
  return quick && !BY_PROCESSOR.test(renderer) ? "card" : "processor";
}

/**
 * How this page draws. `?graphics=card`, `coarse`, `processor` or `none` in its address has it draw so whatever is found.
 * @returns {Graphics}
 */
export function graphics() {
  known ??= asked(location.search) ?? graphicsOf(probed());
  return known;
}

/** What an address asks for; null for nothing that is known. @param {string} search @returns {Graphics | null} */
export function asked(search) {
  const wanted = new URLSearchParams(search).get("graphics");
  return WAYS.find((way) => way === wanted) ?? null;
}

function probed() {
  const [quick, any] = [true, false].map(contextOf);
  const context = quick ?? any;
  // The name is masked in some browsers, and in others told without the extension.
  const about = context?.getExtension("WEBGL_debug_renderer_info");
  const renderer = context?.getParameter(about ? about.UNMASKED_RENDERER_WEBGL : context.RENDERER) ?? "";
  for (const one of [quick, any]) one?.getExtension("WEBGL_lose_context")?.loseContext();
  return { webgl: context !== null, quick: quick !== null, renderer: String(renderer) };
}

/** @param {boolean} failIfMajorPerformanceCaveat */
function contextOf(failIfMajorPerformanceCaveat) {
  return document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat });
}
