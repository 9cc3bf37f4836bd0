/**
 * Reads the binary glTF that the server writes of a head: meshes by name, each with its attributes as typed
 * arrays, and the nodes. Only what that file holds is understood: no sparse accessors, no interleaving.
 */

const ARRAYS = {
  5121: Uint8Array,
  5123: Uint16Array,
  5125: Uint32Array,
  5126: Float32Array,
};
const WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };

/**
 * @param {ArrayBuffer} buffer
 * @returns {{meshes: Record<string, Mesh>, nodes: object[], skins: object[], images: Blob[]}}
 * @typedef {{attributes: Record<string, {array: any, width: number, normalized: boolean}>,
 *            index: Uint32Array, material: object}} Mesh
 */
export function readGlb(buffer) {
  const view = new DataView(buffer);
  const length = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, length)));
  const start = 20 + length + 8;
  /** @type {Record<string, Mesh>} */
  const meshes = {};
  for (const mesh of json.meshes) meshes[mesh.name] = readMesh(json, buffer, start, mesh.primitives[0]);
  const images = (json.images ?? []).map(({ bufferView, mimeType }) => {
    const { byteOffset = 0, byteLength } = json.bufferViews[bufferView];
    return new Blob([new Uint8Array(buffer, start + byteOffset, byteLength)], { type: mimeType });
  });
  return { meshes, nodes: json.nodes, skins: json.skins ?? [], images };
}

function readMesh(json, buffer, start, primitive) {
  /** @type {Mesh["attributes"]} */
  const attributes = {};
  for (const [name, index] of Object.entries(primitive.attributes)) {
    attributes[name] = readAccessor(json, buffer, start, index);
  }
  const index = readAccessor(json, buffer, start, primitive.indices).array;
  return { attributes, index, material: json.materials[primitive.material] };
}

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
