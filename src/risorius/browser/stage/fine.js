/**
 * Fine pictures of heads where no graphics card draws. One takes long, so that it is made beside the stage's own, a part
 * at a time: who moves something meanwhile waits for no more than that part.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { drawn } from "./fence.js";
/** @import {Cut, Mesh} from "../types.js" */
/** @import {Figure} from "./figure.js" */

const MOST = 20_000; // triangles to a part

/**
 * @typedef {{figure: import("./figure.js").Figure, x: number, width: number, paint: (cut: Cut) => void}} Place
 * @typedef {{width: number, height: number, camera: THREE.Camera, places: Place[]}} Seen pixels; who stands where
 * @typedef {{meshes: Mesh[], start: number}} Batch meshes that are drawn at once, from this place of their index on
 */

export class Fine {
  #renderer;
  #scene;
  /** @type {THREE.WebGLRenderTarget | null} */
  #target = null;

  /** @param {THREE.WebGLRenderer} renderer @param {THREE.Scene} scene with the heads */
  constructor(renderer, scene) {
    this.#renderer = renderer;
    this.#scene = scene;
  }

  /**
   * Make a picture of the faces that the figures have now.
   * @param {Seen} seen @param {() => boolean} wanted asked after each part: whether to go on
   * @returns {Promise<ImageData | null>} null where it is not wanted any more
   */
  async picture({ width, height, camera, places }, wanted) {
    await this.#renderer.compileAsync(this.#scene, camera);
    for (const place of places) {
      if (!wanted()) return null;
      for (const part of this.#parts(place, camera, width, height)) {
        part();
        await drawn(this.#renderer.getContext());
        if (!wanted()) return null;
      }
    }
    const pixels = new Uint8ClampedArray(4 * width * height);
    await this.#renderer.readRenderTargetPixelsAsync(this.#sized(width, height), 0, 0, width, height, pixels);
    return wanted() ? upright(pixels, width, height) : null;
  }

  /**
   * What is drawn at a place, one after another: what is behind, then meshes, those that let others through last.
   * @param {Place} place @param {THREE.Camera} camera @param {number} whole @param {number} height
   */
  *#parts({ figure, x, width, paint }, camera, whole, height) {
    const target = this.#sized(whole, height);
    /** @param {number} from @param {number} up @param {number} across @param {number} high */
    const cut = (from, up, across, high) => {
      target.scissor.set(from, up, across, high);
      this.#renderer.setRenderTarget(target);
    };
    /** @param {() => void} draw */
    const within = (draw) => () => {
      target.viewport.set(x, 0, width, height);
      cut(x, 0, width, height);
      draw();
      this.#renderer.setRenderTarget(null);
    };
    yield within(() => {
      figure.ready(true, camera, height, this.#renderer);
      paint(cut);
      cut(x, 0, width, height);
      this.#renderer.clear(false, true, true);
    });
    for (const batch of batches(figure.whole)) yield within(() => this.#draw(figure, batch, camera));
  }

  /** @param {Figure} figure @param {Batch} batch @param {THREE.Camera} camera */
  #draw(figure, { meshes, start }, camera) {
    const others = this.#scene.children.filter((child) => "isGroup" in child && child !== figure.group);
    const hidden = [...others, ...figure.whole.filter((one) => !meshes.includes(one))];
    for (const one of hidden) one.visible = false;
    figure.group.visible = true;
    for (const { geometry } of meshes) geometry.setDrawRange(start, 3 * MOST);
    this.#renderer.render(this.#scene, camera);
    for (const { geometry } of meshes) geometry.setDrawRange(0, Infinity);
    for (const one of hidden) one.visible = true;
  }

  /**
   * Colours are the same as on the stage: developed as film, and of the screen.
   * @param {number} width @param {number} height
   */
  #sized(width, height) {
    let target = this.#target;
    if (target === null) {
      target = this.#target = new THREE.WebGLRenderTarget(width, height, { colorSpace: THREE.SRGBColorSpace });
      target.texture.internalFormat = "RGBA8";
      /** @type {any} */ (target).isXRRenderTarget = true;
      target.scissorTest = true;
    }
    target.setSize(width, height);
    return target;
  }
}

/** @param {number} width @param {number} height @param {Uint8ClampedArray} pixels from the lowest row on */
function upright(pixels, width, height) {
  const picture = new ImageData(width, height);
  for (let y = 0; y < height; y++) {
    picture.data.set(pixels.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
  }
  return picture;
}

/** Small meshes together, since each part is waited for, and pieces of large ones. @param {Mesh[]} meshes @returns {Batch[]} */
function batches(meshes) {
  /** @type {Batch[]} */
  const found = [];
  let room = 0;
  for (const mesh of meshes) {
    const { count } = /** @type {THREE.BufferAttribute} */ (mesh.geometry.index);
    if (count <= room) found[found.length - 1].meshes.push(mesh);
    else for (let start = 0; start < count; start += 3 * MOST) found.push({ meshes: [mesh], start });
    room = count <= room ? room - count : 3 * MOST - count;
  }
  return found;
}
