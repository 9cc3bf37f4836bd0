/** The data embedded in the page: blocks of base64, most of them deflated (`page_faces.py` packs the faces). */

import { bytesOf } from "./take.js";

/** @param {string} name @returns {Uint8Array | null} a block's bytes; null if the page has no such block */
export function block(name) {
  const element = document.getElementById(`data-${name}`);
  return element && bytesOf(element.textContent ?? "");
}

/** @param {string} name @returns {Promise<ArrayBuffer>} a block's bytes, inflated */
export function inflated(name) {
  const stream = new Blob([/** @type {any} */ (block(name))]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

/** Put bytes in order that are stored by significance: all first bytes of the numbers, then all second ones. @param {ArrayBuffer} buffer */
export function woven(buffer) {
  const from = new Uint8Array(buffer);
  const [bytes, count] = [new Uint8Array(from.length), from.length / 4];
  for (let plane = 0, k = 0; plane < 4; plane++) for (let to = plane; k < (plane + 1) * count; to += 4) bytes[to] = from[k++];
  return bytes.buffer;
}
