/** What the page holds: blocks of base64, most of them deflated (`page_faces.py` says how faces are packed). */

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

/** Bytes of which all first ones of four come first, put in order. @param {ArrayBuffer} buffer */
export function woven(buffer) {
  const from = new Uint8Array(buffer);
  const [bytes, count] = [new Uint8Array(from.length), from.length / 4];
  for (let plane = 0, k = 0; plane < 4; plane++) for (let to = plane; k < (plane + 1) * count; to += 4) bytes[to] = from[k++];
  return bytes.buffer;
}
