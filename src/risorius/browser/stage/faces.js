/**
 * Faces as the server sends them (packed by `face_packer.py`), and a window of them around the
 * playhead, so that memory does not grow with the length of a line.
 */

export const KINDS = { take: 1, dial: 2, moment: 3 };
const HEADER = 6;

/**
 * @typedef {{points: Int16Array, folds: Uint8Array | Int16Array, head: Float32Array, eyes: Float32Array[], jaw: number, lips: number}} Face
 * `folds` are the heights of the fine wrinkles, `lips` is how much blood these gain; `points` are steps from the origin that the head's description states; turns are quaternions x, y, z, w.
 */

/**
 * Unpack a binary message.
 * @param {ArrayBuffer} buffer
 * @returns {{kind: number, take: number, first: number, faces: Face[]}}
 */
export function unpackFaces(buffer) {
  const [kind, take, first, count, vertices, pose] = new Uint32Array(buffer, 0, HEADER);
  const poses = new Float32Array(buffer, 4 * HEADER, count * pose);
  const start = 4 * (HEADER + count * pose);
  const after = start + 6 * vertices * count;
  const folds = (buffer.byteLength - after) / Math.max(count, 1);
  const faces = Array.from({ length: count }, (_, k) => {
    const turns = poses.subarray(k * pose, (k + 1) * pose);
    return {
      points: new Int16Array(buffer, start + 6 * vertices * k, 3 * vertices),
      folds: new Uint8Array(buffer, after + folds * k, folds),
      head: turns.subarray(0, 4),
      eyes: [turns.subarray(4, 8), turns.subarray(8, 12)],
      jaw: turns[12],
      lips: turns[13],
    };
  });
  return { kind, take, first, faces };
}
