/** The stage: draws one head, or two side by side, whenever something has changed. */

import * as THREE from "../vendor/three/three.module.min.js";
import { Backdrop } from "./backdrop.js";
import { View } from "./cameras.js";
import { PixelRatio } from "./pixel_ratio.js";
import { developAsFilm } from "./tone.js";

const REST = 800; // ms without motion after which the head is at rest

export class Stage {
  #canvas;
  #renderer;
  #scene = new THREE.Scene();
  /** @type {import("./figure.js").Figure[]} */
  #figures = [];
  #ratio = new PixelRatio();
  /** @type {Backdrop | null} */
  #backdrop = null;
  #asked = false;
  #drawing = false;
  #drawn = 0;
  #playing = false;
  #atRest = false;
  #timer = 0;
  #size = "";
  /** The camera. */
  view = new View(() => this.invalidate());

  /** @param {HTMLCanvasElement} canvas @param {{smooth?: boolean}} [how] `smooth`: whether edges are smoothed */
  constructor(canvas, { smooth = true } = {}) {
    this.#canvas = canvas;
    this.#renderer = new THREE.WebGLRenderer({ canvas, alpha: false, antialias: smooth });
    this.#renderer.autoClear = false;
    developAsFilm(this.#renderer);
    this.dress();
    document.addEventListener("theme", () => this.dress());
    this.view.listen(canvas);
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
  }

  /** Apply the page's colours. */
  dress() {
    this.#backdrop = new Backdrop(this.#canvas);
    this.invalidate();
  }

  /** Pictures drawn so far. */
  get drawn() {
    return this.#drawn;
  }

  /** Show these figures, from left to right. @param {import("./figure.js").Figure[]} figures */
  set figures(figures) {
    for (const { group } of this.#figures) group.removeFromParent();
    this.#figures = figures;
    for (const { group } of figures) this.#scene.add(group);
    this.#resize();
  }

  /** Whether the clock runs or is about to: then the stage counts as moving, even if pictures come slowly. @param {boolean} playing */
  set playing(playing) {
    this.#playing = playing;
    this.#moves();
  }

  /** Request a picture, because something moved. */
  invalidate() {
    this.#moves();
    this.#ask();
  }

  #moves() {
    this.#atRest = false;
    clearTimeout(this.#timer);
    if (!this.#playing) this.#timer = setTimeout(() => this.#rest(), REST);
  }

  #rest() {
    this.#atRest = true;
    if (this.#ratio.share < 1) this.#ask();
  }

  /** Draw now if this frame of the page has no picture yet; else on the next. */
  #ask() {
    this.#asked = true;
    if (!this.#drawing) this.#answer();
  }

  #answer() {
    this.#drawing = this.#asked;
    if (!this.#asked) return;
    this.#asked = false;
    this.#draw();
    requestAnimationFrame(() => this.#answer());
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    this.view.fit(width / Math.max(this.#figures.length, 1), height);
    this.invalidate();
  }

  /**
   * Apply the canvas's size and pixel ratio, only before drawing: it clears the picture.
   * @param {number} width @param {number} height
   */
  #fit(width, height) {
    const ratio = (this.#atRest ? 1 : this.#ratio.share) * Math.min(window.devicePixelRatio, 2);
    const size = [width, height, ratio].join();
    if (size === this.#size) return;
    this.#size = size;
    this.#renderer.setDrawingBufferSize(width, height, ratio);
  }

  #draw() {
    const renderer = this.#renderer;
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    this.#fit(width, height);
    const each = width / Math.max(this.#figures.length, 1);
    renderer.setScissorTest(true);
    this.#figures.forEach((shown, place) => {
      for (const figure of this.#figures) figure.group.visible = figure === shown;
      shown.ready(this.view.camera, height * renderer.getPixelRatio(), renderer);
      renderer.setViewport(place * each, 0, each, height);
      this.#backdrop?.paint(renderer, place * each, each, height, (x, y, w, h) => renderer.setScissor(x, y, w, h));
      renderer.setScissor(place * each, 0, each, height);
      renderer.clear(false, true, true);
      renderer.render(this.#scene, this.view.camera);
    });
    this.#drawn += 1;
    if (!this.#atRest) this.#ratio.drew(performance.now());
  }
}
