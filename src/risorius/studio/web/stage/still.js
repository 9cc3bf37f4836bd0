/**
 * The fine picture of heads at rest, where no graphics card draws. It takes long, so that it is made beside the stage's
 * own, a part at a time: who moves something meanwhile waits for no more than that part. It is shown when it is whole.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { drawn } from "./fence.js";

const MOST = 20_000; // triangles to a part

export class Still {
  #renderer;
  #scene;
  #canvas;
  #target = null;
  #job = 0;

  /**
   * @param {THREE.WebGLRenderer} renderer @param {THREE.Scene} scene with the heads
   * @param {HTMLCanvasElement} below the stage's own canvas, over which the picture lies
   */
  constructor(renderer, scene, below) {
    this.#renderer = renderer;
    this.#scene = scene;
    this.#canvas = document.createElement("canvas");
    this.#canvas.className = "still";
    this.#canvas.hidden = true;
    this.#canvas.setAttribute("aria-hidden", "true");
    below.after(this.#canvas);
  }

  /** Whether it is shown. */
  get shown() {
    return !this.#canvas.hidden;
  }

  /** Give up what is being made. */
  stop() {
    this.#job += 1;
  }

  /** Something moves: the stage's own picture is to be seen. */
  hide() {
    this.stop();
    this.#canvas.hidden = true;
  }

  /**
   * Make the picture, unless it is given up, and show it.
   * @param {{width: number, height: number, camera: THREE.Camera, places: Place[]}} seen pixels; who stands where
   * @typedef {{figure: import("./figure.js").Figure, x: number, width: number, paint: (cut: Function) => void}} Place
   */
  async make({ width, height, camera, places }) {
    const job = ++this.#job;
    await this.#renderer.compileAsync(this.#scene, camera);
    for (const place of places) {
      if (job !== this.#job) return;
      for (const part of this.#parts(place, camera, width, height)) {
        part();
        await drawn(this.#renderer.getContext());
        if (job !== this.#job) return;
      }
    }
    const pixels = new Uint8ClampedArray(4 * width * height);
    await this.#renderer.readRenderTargetPixelsAsync(this.#target, 0, 0, width, height, pixels);
    if (job === this.#job) this.#show(pixels, width, height);
  }

  /** What is drawn at a place, one after another: what is behind, then meshes, those that let others through last. */
  *#parts({ figure, x, width, paint }, camera, whole, height) {
    const target = this.#sized(whole, height);
    const cut = (from, up, across, high) => {
      target.scissor.set(from, up, across, high);
      this.#renderer.setRenderTarget(target);
    };
    const within = (draw) => () => {
      target.viewport.set(x, 0, width, height);
      cut(x, 0, width, height);
      draw();
      this.#renderer.setRenderTarget(null);
    };
    yield within(() => {
      figure.ready(true, camera, height);
      paint(cut);
      cut(x, 0, width, height);
      this.#renderer.clear(false, true, true);
    });
    for (const mesh of figure.whole) {
      const { count } = mesh.geometry.index;
      for (let start = 0; start < count; start += 3 * MOST) {
        yield within(() => this.#draw(figure, mesh, start, camera));
      }
    }
  }

  #draw(figure, mesh, start, camera) {
    const others = this.#scene.children.filter((child) => child.isGroup && child !== figure.group);
    const hidden = [...others, ...figure.whole.filter((one) => one !== mesh)];
    for (const one of hidden) one.visible = false;
    figure.group.visible = true;
    mesh.geometry.setDrawRange(start, 3 * MOST);
    this.#renderer.render(this.#scene, camera);
    mesh.geometry.setDrawRange(0, Infinity);
    for (const one of hidden) one.visible = true;
  }

  /** Colours are the same as on the stage: developed as film, and of the screen. */
  #sized(width, height) {
    if (this.#target === null) {
      this.#target = new THREE.WebGLRenderTarget(width, height, { colorSpace: THREE.SRGBColorSpace });
      this.#target.texture.internalFormat = "RGBA8";
      this.#target.isXRRenderTarget = true;
      this.#target.scissorTest = true;
    }
    this.#target.setSize(width, height);
    return this.#target;
  }

  /** @param {Uint8ClampedArray} pixels from the lowest row on */
  #show(pixels, width, height) {
    const picture = new ImageData(width, height);
    for (let y = 0; y < height; y++) {
      picture.data.set(pixels.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
    }
    Object.assign(this.#canvas, { width, height });
    this.#canvas.getContext("2d", { alpha: false, willReadFrequently: true }).putImageData(picture, 0, 0);
    this.#canvas.hidden = false;
  }
}
