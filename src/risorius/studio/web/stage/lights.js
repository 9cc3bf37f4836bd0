/** The library's light in the scene, and the surroundings that the eyes mirror. */

import * as THREE from "../vendor/three/three.module.min.js";
/** @import {StageLight, StageLamp} from "../wire.js" */

const FAR = 4; // m at which a lamp's window stands in the mirrored room
const PANE = 0.62; // m: half its side

/**
 * The lamps are directional lights in the order that the skin's `reach` has them.
 * @param {StageLight} light lamps, sky and ground as the server describes them; colours are the light on a white
 *   surface that faces them, so that three.js, which divides by π, wants π times as much
 * @returns {THREE.Object3D[]}
 */
export function lightsOf({ lamps, sky, ground }) {
  const room = new THREE.HemisphereLight(new THREE.Color(...sky), new THREE.Color(...ground), Math.PI);
  return [
    room,
    ...lamps.map(({ direction, colour }) => {
      const lamp = new THREE.DirectionalLight(new THREE.Color(...colour), Math.PI);
      lamp.position.fromArray(direction);
      return lamp;
    }),
  ];
}

/** @param {THREE.WebGLRenderer} renderer @param {StageLight} light @returns {THREE.Texture} a room with windows */
export function mirrored(renderer, { lamps, sky }) {
  const room = new THREE.Scene();
  const walls = new THREE.MeshBasicMaterial({ color: new THREE.Color(...sky), side: THREE.BackSide });
  room.add(new THREE.Mesh(new THREE.SphereGeometry(2 * FAR), walls));
  for (const lamp of lamps) room.add(pane(lamp));
  const generator = new THREE.PMREMGenerator(renderer);
  const { texture } = generator.fromScene(room, 0);
  generator.dispose();
  return texture;
}

/** @param {StageLamp} lamp */
function pane({ direction, colour }) {
  const bright = new THREE.Color(...colour).multiplyScalar(24);
  const material = new THREE.MeshBasicMaterial({ color: bright, side: THREE.DoubleSide });
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(2 * PANE, 2 * PANE), material);
  mesh.position.fromArray(direction).multiplyScalar(FAR);
  mesh.lookAt(0, 0, 0);
  return mesh;
}
