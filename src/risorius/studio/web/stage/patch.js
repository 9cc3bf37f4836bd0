/** Other text in place of parts of three.js's shaders. */

/** @param {string} text @param {[string, string][]} pairs what is replaced, by what */
export function replaced(text, pairs) {
  return pairs.reduce((now, [from, to]) => now.replace(from, to), text);
}

/**
 * @param {import("three").Material} material
 * @param {{vertex?: [string, string][], fragment?: [string, string][], light?: [string, string][]}} parts `light` is
 *   what is replaced in the fragment shader where light is worked out
 * @param {Record<string, {value: any}>} uniforms
 */
export function patch(material, { vertex = [], fragment = [], light = [] }, uniforms = {}) {
  // three.js tells shaders apart by the text of onBeforeCompile, which is the same for all of these.
  material.customProgramCacheKey = () => JSON.stringify([vertex, fragment, light]);
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = replaced(shader.vertexShader, vertex);
    shader.fragmentShader = replaced(shader.fragmentShader, [...fragment, ...light]);
  };
}
