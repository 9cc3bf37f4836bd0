#!/bin/sh
# osc-js writes a VMC expression name such as "あ" as another letter ("B"): it keeps the low byte of each character. It reads UTF-8 right.
# Guess before the run: osc, osc-min and node-osc read UTF-8 right and osc-js does not. It was wrong: all read it. Of writing there
# was no guess; one expects UTF-8 from each.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --ignore-scripts osc@2.4.5 osc-min@2.1.2 node-osc@11.7.1 osc-js@2.4.1
cat >check.mjs <<'JS'
import { createRequire } from "node:module";
import * as nodeOsc from "node-osc";
import * as oscMin from "osc-min";

const require = createRequire(import.meta.url);
const osc = require("osc");
const OscJs = require("osc-js");
const address = "/VMC/Ext/Blend/Val";

function bytes(name, library) {
  const made = {
    osc: () => osc.writePacket({ address, args: [{ type: "s", value: name }, { type: "f", value: 0.5 }] }),
    "osc-min": () => oscMin.toBuffer({ oscType: "message", address, args: [name, 0.5] }),
    "node-osc": () => nodeOsc.encode(new nodeOsc.Message(address, name, 0.5)),
    "osc-js": () => new OscJs.Message(address, name, 0.5).pack(),
  }[library]();
  return Buffer.from(made.buffer ? new Uint8Array(made.buffer, made.byteOffset, made.byteLength) : made);
}

// The address takes 20 bytes, the tags ",sf" 4, the weight the last 4.
const nameIn = (packet) => packet.subarray(24, -4).toString("utf8").replace(/\0+$/, "");

function readByOscJs(packet) {
  const read = new OscJs.Message();
  read.unpack(new DataView(new Uint8Array(packet).buffer));
  return read.args[0];
}

const names = ["Joy", "あ", "まばたき"];
const seen = Object.fromEntries(
  ["osc", "osc-min", "node-osc", "osc-js"].map((library) => [library, names.map((name) => nameIn(bytes(name, library)))]),
);
const read = names.map((name) => readByOscJs(bytes(name, "osc")));
console.log("version: osc-js 2.4.1 (beside osc 2.4.5, osc-min 2.1.2, node-osc 11.7.1)");
console.log("behaviour: written", JSON.stringify(seen), "read by osc-js", JSON.stringify(read));
console.log("expected:", JSON.stringify(names), "from each, as VMC has it (UTF-8), or an error");
const right = (list) => list.join() === names.join();
const same =
  ["osc", "osc-min", "node-osc"].every((library) => right(seen[library])) && right(read) &&
  seen["osc-js"][0] === "Joy" && seen["osc-js"][1] === "B" && !right(seen["osc-js"]);
if (!same) {
  console.error("the behaviour has changed");
  process.exit(1);
}
JS
node check.mjs
