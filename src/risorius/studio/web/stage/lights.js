/** The library's light in the scene, for what is neither skin nor eye. */

import * as THREE from "../vendor/three/three.module.min.js";
/** @import {StageLight} from "../wire.js" */

/**
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
