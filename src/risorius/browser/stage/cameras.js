/** The camera: named views, turning and zooming by mouse, touch and keys. */

import * as THREE from "../vendor/three/three.module.min.js";
/** @import {CameraState} from "../types.js" */

// Centre in metres in the head's frame, visible height in metres, turn and tilt in degrees.
/** @type {Record<string, {label: string} & CameraState>} */
export const VIEWS = {
  front: { label: "Front", centre: [0, 0.0, 0.03], height: 0.31, turn: 0, tilt: 0 },
  three_quarter: { label: "Three-quarter", centre: [0, -0.005, -0.02], height: 0.32, turn: 35, tilt: 4 },
  side: { label: "Side", centre: [0, -0.005, -0.02], height: 0.32, turn: 90, tilt: 0 },
  mouth: { label: "Mouth", centre: [0, -0.055, 0.08], height: 0.13, turn: 0, tilt: 0 },
};

const FIELD = 18; // degrees: long enough a lens to keep the face's proportions
const NEAREST = 0.06; // m of visible height
const FARTHEST = 0.9;
const STEEPEST = 80; // degrees
const TURN_PER_PIXEL = 0.4; // degrees
const ZOOM_PER_NOTCH = 1.0012;

export class View {
  camera = new THREE.PerspectiveCamera(FIELD, 1, 0.1, 10);
  #centre = new THREE.Vector3();
  #height = 0;
  #turn = 0;
  #tilt = 0;
  #changed;
  /** @type {(() => void)[]} */
  #calls = [];

  /** @param {() => void} changed called when the view changes */
  constructor(changed) {
    this.#changed = changed;
    this.#take(VIEWS.front);
  }

  /** Listen for changes of the view. @param {() => void} call */
  onmove(call) {
    this.#calls.push(call);
  }

  /** The name of the view, or null if it was turned, moved or zoomed since. */
  get name() {
    const own = JSON.stringify(this.state);
    const name = Object.keys(VIEWS).find((known) => {
      const { centre, height, turn, tilt } = VIEWS[known];
      return JSON.stringify({ centre, height, turn, tilt }) === own;
    });
    return name ?? null;
  }

  /** @param {string} name one of VIEWS */
  choose(name) {
    this.state = VIEWS[name];
  }

  /** @param {number} across degrees @param {number} up degrees */
  orbit(across, up) {
    this.#turn += across;
    this.#tilt = THREE.MathUtils.clamp(this.#tilt + up, -STEEPEST, STEEPEST);
    this.#moved();
  }

  /** @param {number} factor on the visible height */
  zoom(factor) {
    this.#height = THREE.MathUtils.clamp(this.#height * factor, NEAREST, FARTHEST);
    this.#moved();
  }

  /** @param {number} across @param {number} up shares of the visible height */
  shift(across, up) {
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 0);
    const above = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 1);
    this.#centre.addScaledVector(right, -across * this.#height).addScaledVector(above, up * this.#height);
    this.#moved();
  }

  /** The state to save with the project. @returns {CameraState} */
  get state() {
    const { x, y, z } = this.#centre;
    return { centre: [x, y, z], height: this.#height, turn: this.#turn, tilt: this.#tilt };
  }

  set state(state) {
    this.#take(state);
    this.#moved();
  }

  /**
   * Fit to a picture of this shape: the view's height is visible, or in a narrow picture the same length across.
   * @param {number} width @param {number} height
   */
  fit(width, height) {
    this.camera.aspect = width / height;
    this.#place();
  }

  /** Let the pointer turn, shift (with shift or the right button) and zoom on an element. @param {HTMLElement} element */
  listen(element) {
    /** @type {Map<number, [x: number, y: number]>} */
    const pointers = new Map();
    element.addEventListener("pointerdown", (event) => {
      element.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    element.addEventListener("pointermove", (event) => {
      if (pointers.has(event.pointerId)) this.#drag(pointers, event, element.clientHeight);
    });
    for (const name of /** @type {("pointerup" | "pointercancel")[]} */ (["pointerup", "pointercancel"])) {
      element.addEventListener(name, (event) => pointers.delete(event.pointerId));
    }
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
  }

  /** @param {Map<number, [x: number, y: number]>} pointers @param {PointerEvent} event @param {number} height */
  #drag(pointers, event, height) {
    const [x, y] = pointers.get(event.pointerId) ?? [event.clientX, event.clientY];
    const [across, down] = [event.clientX - x, event.clientY - y];
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1] ?? [x, y];
      /** @param {number} px @param {number} py */
      const apart = (px, py) => Math.hypot(px - other[0], py - other[1]);
      this.zoom(apart(x, y) / Math.max(apart(event.clientX, event.clientY), 1));
    } else if (event.shiftKey || event.buttons === 2) this.shift(across / height, down / height);
    else this.orbit(-across * TURN_PER_PIXEL, down * TURN_PER_PIXEL);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  /** @param {WheelEvent} event */
  #wheel(event) {
    event.preventDefault();
    this.zoom(ZOOM_PER_NOTCH ** event.deltaY);
  }

  /** @param {CameraState} state */
  #take({ centre, height, turn, tilt }) {
    this.#centre.fromArray(centre);
    [this.#height, this.#turn, this.#tilt] = [height, turn, tilt];
  }

  #moved() {
    this.#place();
    this.#changed();
    for (const call of this.#calls) call();
  }

  #place() {
    const { camera } = this;
    const narrow = Math.min(1, camera.aspect / 0.82);
    const distance = this.#height / 2 / Math.tan(THREE.MathUtils.degToRad(FIELD / 2)) / narrow;
    const turn = THREE.MathUtils.degToRad(this.#turn);
    const tilt = THREE.MathUtils.degToRad(this.#tilt);
    camera.position.set(
      this.#centre.x + distance * Math.sin(turn) * Math.cos(tilt),
      this.#centre.y + distance * Math.sin(tilt),
      this.#centre.z + distance * Math.cos(turn) * Math.cos(tilt),
    );
    camera.lookAt(this.#centre);
    camera.updateMatrix();
    camera.updateProjectionMatrix();
  }
}
