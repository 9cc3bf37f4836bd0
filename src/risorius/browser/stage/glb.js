/**
 * Reads the binary glTF that the server writes of a head: meshes by name, each with its attributes as typed
 * arrays, and the nodes. It reads only what that file contains: no sparse accessors, no interleaving.
 */

/** @import {Attribute, FileMesh, HeadFile, Numbers} from "../types.js" */
/**
 * @typedef {{attributes: Record<string, number>, indices: number, material: number}} GltfPrimitive
 * @typedef {Object} Gltf the parts of the file's JSON that are read
 * @property {{name: string, primitives: GltfPrimitive[]}[]} meshes
 * @property {{bufferView: number, mimeType: string}[]} [images]
 * @property {{byteOffset?: number, byteLength: number}[]} bufferViews
 * @property {FileMesh["material"][]} materials
 * @property {HeadFile["nodes"]} nodes
 * @property {object[]} [skins]
 * @property {{bufferView: number, byteOffset?: number, componentType: number, count: number, type: string,
 *             normalized?: boolean}[]} accessors
 */

/** @type {Record<number, new (buffer: ArrayBuffer, start: number, count: number) => Numbers>} */
const ARRAYS = {
  5121: Uint8Array,
  5123: Uint16Array,
  5125: Uint32Array,
  5126: Float32Array,
};
/** @type {Record<string, number>} */
const WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };

/**
 * @param {ArrayBuffer} buffer
 * @returns {HeadFile}
 */
export function readGlb(buffer) {
  const view = new DataView(buffer);
  const length = view.getUint32(12, true);
  /** @type {Gltf} */
  const json = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, length)));
  const start = 20 + length + 8;
  /** @type {HeadFile["meshes"]} */
  const meshes = {};
  for (const mesh of json.meshes) meshes[mesh.name] = readMesh(json, buffer, start, mesh.primitives[0]);
  const images = (json.images ?? []).map(({ bufferView, mimeType }) => {
    const { byteOffset = 0, byteLength } = json.bufferViews[bufferView];
    return new Blob([new Uint8Array(buffer, start + byteOffset, byteLength)], { type: mimeType });
  });
  return { meshes, nodes: json.nodes, skins: json.skins ?? [], images };
}

/**
 * @param {Gltf} json @param {ArrayBuffer} buffer @param {number} start @param {GltfPrimitive} primitive
 * @returns {FileMesh}
 */
function readMesh(json, buffer, start, primitive) {
  /** @type {FileMesh["attributes"]} */
  const attributes = {};
  for (const [name, index] of Object.entries(primitive.attributes)) {
    attributes[name] = readAccessor(json, buffer, start, index);
  }
  const index = /** @type {FileMesh["index"]} */ (readAccessor(json, buffer, start, primitive.indices).array);
  return { attributes, index, material: json.materials[primitive.material] };
}

/** @param {Gltf} json @param {ArrayBuffer} buffer @param {number} start @param {number} index @returns {Attribute} */
function readAccessor(json, buffer, start, index) {
  const {
    bufferView,
    byteOffset = 0,
    componentType,
    count,
    type,
    normalized = false,
  } = json.accessors[index];
  const view = json.bufferViews[bufferView];
  const width = WIDTHS[type];
  const from = start + (view.byteOffset ?? 0) + byteOffset;
  return { array: new ARRAYS[componentType](buffer, from, count * width), width, normalized };
}
