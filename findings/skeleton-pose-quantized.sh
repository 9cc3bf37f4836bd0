#!/bin/sh
# three's Skeleton.pose() moves and scales a skinned model that gltf-transform's quantize() or gltfpack has packed: both keep the scale
# of the packed positions in the inverse bind matrices, and pose() takes the places of the bones from these.
# Expected (met by chance first, so no blind guess): the model at rest looks the same before and after pose().
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 gltfpack@1.3.0 \
  @gltf-transform/core@4.5.1 @gltf-transform/extensions@4.5.1 @gltf-transform/functions@4.5.1
cat >check.mjs <<'JS'
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { Document, Logger, NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import { quantize } from "@gltf-transform/functions";
import { Box3, Vector3 } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

globalThis.self = globalThis;
globalThis.ProgressEvent ??= class {};

/** A pipe of 2 x 10 x 2 with a joint at its foot and one in its middle. */
function pipe() {
  const made = new Document().setLogger(new Logger(Logger.Verbosity.SILENT));
  const buffer = made.createBuffer();
  const accessor = (type, array) => made.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const corners = [0, 5, 10].flatMap((y) => [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, z]) => [x, y, z]));
  const sides = [0, 1].flatMap((row) => [0, 1, 2, 3].map((i) => [4 * row + i, 4 * row + ((i + 1) % 4)]));
  const primitive = made
    .createPrimitive()
    .setAttribute("POSITION", accessor("VEC3", new Float32Array(corners.flat())))
    .setAttribute("JOINTS_0", accessor("VEC4", new Uint8Array(corners.flatMap(([, y]) => [y >= 5 ? 1 : 0, 0, 0, 0]))))
    .setAttribute("WEIGHTS_0", accessor("VEC4", new Float32Array(corners.flatMap(() => [1, 0, 0, 0]))))
    .setIndices(accessor("SCALAR", new Uint16Array(sides.flatMap(([a, b]) => [a, b, a + 4, b, b + 4, a + 4]))));
  const tip = made.createNode("tip").setTranslation([0, 5, 0]);
  const root = made.createNode("root").addChild(tip);
  const at = (y) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -y, 0, 1];
  const inverse = accessor("MAT4", new Float32Array([...at(0), ...at(5)]));
  const skin = made.createSkin().addJoint(root).addJoint(tip).setSkeleton(root).setInverseBindMatrices(inverse);
  const body = made.createNode("pipe").setMesh(made.createMesh("pipe").addPrimitive(primitive)).setSkin(skin);
  made.createScene().addChild(root).addChild(body);
  return made;
}

const text = (vector) => vector.toArray().map((value) => +value.toFixed(2)).join(" ");

/** The sizes of the model's box before and after pose(). */
async function sizes(file) {
  const bytes = readFileSync(file);
  const content = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  const { scene } = await new GLTFLoader().parseAsync(content, "");
  let body;
  scene.traverse((object) => (body = object.isSkinnedMesh ? object : body));
  const size = () => {
    scene.updateMatrixWorld(true);
    const box = new Box3();
    for (let i = 0; i < body.geometry.attributes.position.count; i++)
      box.expandByPoint(body.getVertexPosition(i, new Vector3()).applyMatrix4(body.matrixWorld));
    return text(box.getSize(new Vector3()));
  };
  const before = size();
  body.skeleton.pose();
  return { before, after: size() };
}

const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);
const model = pipe();
await io.write("plain.glb", model);
await model.transform(quantize());
await io.write("quantized.glb", model);
execFileSync("node", ["node_modules/gltfpack/cli.js", "-i", "plain.glb", "-o", "packed.glb", "-kn"]);
const seen = {};
for (const name of ["plain", "quantized", "packed"]) seen[name] = await sizes(`${name}.glb`);
console.log("version: three 0.187.0, @gltf-transform/functions 4.5.1 (quantized), gltfpack 1.3.0 (packed)");
console.log("behaviour: size of the model before and after Skeleton.pose():", JSON.stringify(seen));
console.log("expected: 2 10 2 in each");
const same =
  Object.values(seen).every(({ before }) => before === "2 10 2") && seen.plain.after === "2 10 2" &&
  seen.quantized.after === "0.4 2 0.4" && Number(seen.packed.after.split(" ")[1]) > 1000;
if (!same) {
  console.error("the behaviour has changed");
  process.exit(1);
}
JS
node check.mjs
