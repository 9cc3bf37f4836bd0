/** Whether this browser draws without a graphics card: then triangles and pixels cost what else is free. */

let known = null;

/** @returns {boolean} */
export function drawnBySoftware() {
  known ??= /swiftshader|llvmpipe|software/i.test(rendererName());
  return known;
}

function rendererName() {
  const context = document.createElement("canvas").getContext("webgl2");
  const about = context?.getExtension("WEBGL_debug_renderer_info");
  const name = context && about ? context.getParameter(about.UNMASKED_RENDERER_WEBGL) : "";
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return name;
}

export const NO_3D = "This browser cannot draw in 3D here: it has no WebGL 2. Another browser may.";

/** Whether the browser can draw in 3D at all. */
export function draws3d() {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
}
