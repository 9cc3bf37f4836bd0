/** A character on the example page's stage, drawn by the browser. */

import { GLTFLoader } from "../vendor/three/GLTFLoader.js";
import * as THREE from "../vendor/three/three.module.min.js";
import { driving, nodeOf } from "./risorius-live.js";
/** @import {Frame} from "./risorius-live.js" */

export class DrawnCharacter {
  /** The outputs that the server's frames must contain. */
  outputs = ["arkit", "rotations"];
  #renderer;
  #camera = new THREE.PerspectiveCamera(20, 1, 0.01, 20);
  #scene = new THREE.Scene();
  /** @type {THREE.Object3D | null} */
  #character = null;
  /** @type {(frame: Frame | null) => void} */
  #drive = () => {};

  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.#renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#scene.add(new THREE.HemisphereLight(0xffffff, 0x8a7f78, 2.2));
    const lamp = new THREE.DirectionalLight(0xffffff, 2.4);
    lamp.position.set(1, 1.5, 2);
    this.#scene.add(lamp);
  }

  /** Put a head of the server on the stage. @param {string} name */
  loadHead(name) {
    return this.load(`head.glb?head=${encodeURIComponent(name)}`);
  }

  /** Replace the character on the stage. @param {string} address */
  async load(address) {
    const { scene: root } = await new GLTFLoader().loadAsync(address);
    this.#character?.removeFromParent();
    this.#character = root;
    this.#scene.add(root);
    this.#drive = driving(root);
    this.#aim(root);
  }

  /** Draw a frame; null draws the current face again. @param {Frame | null} frame */
  show(frame) {
    const renderer = this.#renderer;
    const { clientWidth: width, clientHeight: height } = renderer.domElement;
    const size = renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) {
      renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
      renderer.setSize(width, height, false);
      this.#camera.aspect = width / height;
      this.#camera.updateProjectionMatrix();
    }
    this.#drive(frame);
    renderer.render(this.#scene, this.#camera);
  }

  /** Point the camera at the eyes, or at the top of the model if it has none. @param {THREE.Object3D} root */
  #aim(root) {
    const box = new THREE.Box3().setFromObject(root);
    /** @param {"left" | "right"} side @returns {THREE.Vector3 | undefined} */
    const eye = (side) => nodeOf(root, side)?.getWorldPosition(new THREE.Vector3());
    const [left, right] = [eye("left"), eye("right")];
    const height = left && right ? 4.6 * left.distanceTo(right) : 0.3 * (box.max.y - box.min.y);
    const centre = left && right ? left.clone().add(right).multiplyScalar(0.5) : box.getCenter(new THREE.Vector3());
    centre.y = left && right ? centre.y - 0.12 * height : box.max.y - 0.5 * height;
    const far = height / 2 / Math.tan(THREE.MathUtils.degToRad(this.#camera.fov / 2));
    this.#camera.position.set(centre.x, centre.y, centre.z + far);
    this.#camera.lookAt(centre);
  }
}
