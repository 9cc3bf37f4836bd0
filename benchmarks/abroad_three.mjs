// Evaluates a file in three.js, without a browser, for abroad.py: asked by JSON on the standard input, it writes a row of
// float32 for each key: the wanted vertices of the skin, the head's quaternion, the directions of both eyes.
import { readFileSync, writeFileSync } from "node:fs";

import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const asked = JSON.parse(readFileSync(0, "utf8"));

/** Without a page there are no pictures: any texture will do. */
const withoutPictures = () => ({ name: "without_pictures", loadTexture: async () => new THREE.Texture() });

function bytes(path) {
  const data = readFileSync(path);
  return data.buffer.slice(data.byteOffset, data.byteOffset + data.byteLength);
}

async function load(data, ...plugins) {
  const loader = new GLTFLoader();
  for (const plugin of [withoutPictures, ...plugins]) loader.register(plugin);
  return loader.parseAsync(data, "");
}

async function played() {
  const gltf = await load(bytes(asked.file));
  return { scene: gltf.scene, clip: gltf.animations[0], update: () => {} };
}

const character = asked.file.endsWith(".vrma") ? await (await import("./abroad_vrm.mjs")).avatar(asked, bytes, load) : await played();
const { scene, clip, update } = character;
const mixer = new THREE.AnimationMixer(scene);
const action = mixer.clipAction(clip);
action.setLoop(THREE.LoopOnce);
action.clampWhenFinished = true;
action.play();
const skin = scene.getObjectByName("skin");
const head = scene.getObjectByName("head");
const eyes = ["eye_left", "eye_right"].map((name) => scene.getObjectByName(name));
const times = clip.tracks[0].times;
const wide = 3 * asked.wanted.length + 10;
const rows = new Float32Array(times.length * wide);
const place = new THREE.Vector3();
const turn = new THREE.Quaternion();
times.forEach((time, key) => {
  mixer.setTime(time);
  update();
  scene.updateMatrixWorld(true);
  let at = key * wide;
  for (const vertex of asked.wanted) {
    skin.getVertexPosition(vertex, place).applyMatrix4(skin.matrixWorld).toArray(rows, at);
    at += 3;
  }
  head.getWorldQuaternion(turn).toArray(rows, at);
  eyes.forEach((eye, side) => {
    place.set(0, 0, 1).applyQuaternion(eye.getWorldQuaternion(turn)).toArray(rows, at + 4 + 3 * side);
  });
});
writeFileSync(asked.out, rows);
