/** The studio's light: a warm key, a cool fill, a rim from behind, and sky; and what the eyes mirror. */

import * as THREE from "../vendor/three/three.module.min.js";

/** @param {THREE.Scene} scene @param {boolean} shadows whether the key casts them */
export function addLights(scene, shadows) {
  scene.add(new THREE.HemisphereLight(0xdfe8f4, 0x6d5546, 0.95));
  const key = directed(0xfff1e2, 2.5, [-0.55, 0.75, 1.1]);
  scene.add(key, key.target);
  scene.add(directed(0xd8e6ff, 0.75, [1.2, 0.1, 0.7]));
  scene.add(directed(0xe6f0ff, 1.6, [0.9, 0.8, -1.2]));
  scene.add(directed(0xfff0e0, 0.7, [-1.2, 0.5, -0.9]));
  if (shadows) castShadows(key);
}

function directed(colour, strength, place) {
  const light = new THREE.DirectionalLight(colour, strength);
  light.position.set(...place);
  return light;
}

function castShadows(light) {
  light.castShadow = true;
  light.shadow.mapSize.set(1024, 1024);
  light.shadow.bias = -0.0004;
  light.shadow.normalBias = 0.0016;
  light.shadow.radius = 5;
  Object.assign(light.shadow.camera, { left: -0.2, right: 0.2, top: 0.22, bottom: -0.22, near: 0.6, far: 2.4 });
}

/** @param {THREE.WebGLRenderer} renderer @returns {THREE.Texture} a room with two windows */
export function surroundings(renderer) {
  const room = new THREE.Scene();
  const wall = new THREE.MeshBasicMaterial({ color: 0x30343a, side: THREE.BackSide });
  room.add(new THREE.Mesh(new THREE.BoxGeometry(10, 8, 10), wall));
  room.add(pane(0xffffff, 9, [-3.2, 2.4, 4.9], [1.7, 2.2]));
  room.add(pane(0xcfe0ff, 3, [3.6, 1.2, 4.9], [1.2, 2.0]));
  const generator = new THREE.PMREMGenerator(renderer);
  const { texture } = generator.fromScene(room, 0.01);
  generator.dispose();
  return texture;
}

function pane(colour, strength, place, size) {
  const material = new THREE.MeshBasicMaterial({ color: new THREE.Color(colour).multiplyScalar(strength) });
  material.side = THREE.DoubleSide;
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(...size), material);
  mesh.position.set(...place);
  return mesh;
}
