import assert from "node:assert/strict";
import { test } from "node:test";
import { asked, graphicsOf } from "../../src/risorius/browser/stage/graphics.js";

const CARDS = [
  "ANGLE (NVIDIA, NVIDIA GeForce RTX 3060 Direct3D11 vs_5_0 ps_5_0, D3D11)",
  "ANGLE (Intel, Intel(R) UHD Graphics 620 (0x00005917) Direct3D11 vs_5_0 ps_5_0, D3D11)",
  "ANGLE (AMD, AMD Radeon Pro 5300M OpenGL Engine, OpenGL 4.1)",
  "ANGLE (Apple, ANGLE Metal Renderer: Apple M1, Unspecified Version)",
  "Mesa Intel(R) UHD Graphics 620 (KBL GT2)",
  "Adreno (TM) 650",
  "Mali-G78",
  "WebKit WebGL",
  "", // masked
];
const PROCESSORS = [
  "ANGLE (Microsoft, Microsoft Basic Render Driver (0x0000008C) Direct3D11 vs_5_0 ps_5_0, D3D11)",
  "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader driver)",
  "Google SwiftShader",
  "llvmpipe (LLVM 15.0.7, 256 bits)",
  "Mesa/X.org, softpipe",
  "Apple Software Renderer",
  "Microsoft WARP",
];

for (const renderer of CARDS) {
  test(`'${renderer}' is a graphics card`, () => assert.equal(graphicsOf({ webgl: true, quick: true, renderer }), "card"));
}
for (const renderer of PROCESSORS) {
  test(`'${renderer}' is the processor`, () => assert.equal(graphicsOf({ webgl: true, quick: true, renderer }), "processor"));
}

test("a renderer that the browser itself calls slow is the processor, whatever its name", () => {
  for (const renderer of [...CARDS, ...PROCESSORS]) assert.equal(graphicsOf({ webgl: true, quick: false, renderer }), "processor");
});

test("without WebGL nothing is drawn", () => assert.equal(graphicsOf({ webgl: false, quick: false, renderer: "" }), "none"));

test("an address may ask for another way", () => {
  assert.equal(asked("?graphics=processor"), "processor");
  assert.equal(asked("?graphics=toString"), null);
  assert.equal(asked(""), null);
});
