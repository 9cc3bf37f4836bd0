/**
 * The stage: draws one head, or two side by side, when there is something new to see.
 *
 * Pictures are made no finer than the machine draws in time: `Sharpness` lowers the resolution while frames
 * take too long, and raises it again when the face is at rest.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { Backdrop } from "./backdrop.js";
import { View } from "./cameras.js";
import { drawn } from "./fence.js";
import { lightsOf, mirrored } from "./lights.js";
import { Sharpness } from "./sharpness.js";
import { drawnBySoftware } from "./software.js";
import { Still } from "./still.js";
import { developAsFilm } from "./tone.js";

export class Stage {
  #canvas;
  #renderer;
  #scene = new THREE.Scene();
  #figures = [];
  #sharpness;
  #backdrop;
  #mirrored = null;
  #asked = false;
  #drawing = false;
  #drawn = 0;
  #still = null;
  #playing = false;
  #size = "";
  /** From where the heads are looked at. */
  view = new View(() => this.invalidate());

  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.#canvas = canvas;
    const rough = drawnBySoftware();
    this.#renderer = new THREE.WebGLRenderer({ canvas, alpha: false, antialias: !rough });
    this.#renderer.autoClear = false;
    developAsFilm(this.#renderer);
    if (rough) this.#still = new Still(this.#renderer, this.#scene, canvas);
    this.#sharpness = new Sharpness(rough, () => (rough ? this.#makeStill() : this.#ask()));
    this.dress();
    document.addEventListener("theme", () => this.dress());
    this.view.listen(canvas);
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
  }

  /**
   * Light the stage, the first time; return what eyes mirror of it.
   * @param {object} light as the server describes it
   */
  lit(light) {
    if (this.#mirrored === null) {
      this.#scene.add(...lightsOf(light));
      this.#mirrored = mirrored(this.#renderer, light);
    }
    return this.#mirrored;
  }

  /** Take up the page's colours. */
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

  /** Whether the clock runs, or is about to. @param {boolean} playing */
  set playing(playing) {
    if (playing) this.stir();
    this.#playing = playing;
    this.#sharpness.playing = playing;
  }

  /** Somebody is about to move something: the fine picture of a head at rest would keep them waiting. */
  stir() {
    if (!this.#still?.shown) this.#still?.stop();
    this.#sharpness.moves();
  }

  /** Draw a picture before long: something moved. */
  invalidate() {
    this.#sharpness.moves();
    this.#ask();
  }

  /** Draw now if this frame of the page has no picture yet, and the last one is drawn; else as soon as may be. */
  #ask() {
    this.#asked = true;
    if (!this.#drawing) this.#answer();
  }

  #answer() {
    this.#drawing = this.#asked;
    if (!this.#asked) return;
    this.#asked = false;
    this.#draw();
    const over = this.#over();
    requestAnimationFrame(() => (over ? over.then(() => this.#done()) : this.#answer()));
  }

  #done() {
    if (this.#asked) this.#sharpness.kept();
    this.#answer();
  }

  /**
   * What the next picture waits for. Without a graphics card those asked for sooner than they are drawn would wait for
   * each other, and who turns a dial for all of them. While it plays nothing is waited for: more are seen so.
   */
  #over() {
    return this.#still && !this.#playing ? drawn(this.#renderer.getContext()) : null;
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    this.view.fit(width / Math.max(this.#figures.length, 1), height);
    this.invalidate();
  }

  /** Take up the canvas' size, as finely as is drawn now: not before a picture, which that clears. */
  #fit(width, height) {
    const { ratio } = this.#sharpness;
    const size = [width, height, ratio].join();
    if (size === this.#size) return;
    this.#size = size;
    this.#renderer.setDrawingBufferSize(width, height, ratio);
  }

  #makeStill() {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0 || this.#figures.length === 0 || this.#still.shown) return;
    const ratio = this.#sharpness.stillRatio(width * height);
    const [across, high] = [Math.floor(width * ratio), Math.floor(height * ratio)];
    const each = Math.floor(across / this.#figures.length);
    const places = this.#figures.map((figure, k) => ({
      figure,
      x: k * each,
      width: each,
      paint: (cut) => this.#backdrop.paint(this.#renderer, k * each, each, high, cut),
    }));
    this.#still.make({ width: across, height: high, camera: this.view.camera, places });
  }

  #draw() {
    const renderer = this.#renderer;
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    this.#still?.hide();
    this.#fit(width, height);
    const each = width / Math.max(this.#figures.length, 1);
    renderer.setScissorTest(true);
    this.#figures.forEach((shown, place) => {
      for (const figure of this.#figures) figure.group.visible = figure === shown;
      shown.ready(this.#sharpness.fine, this.view.camera, height * this.#renderer.getPixelRatio());
      renderer.setViewport(place * each, 0, each, height);
      this.#backdrop.paint(renderer, place * each, each, height, (...given) => renderer.setScissor(...given));
      renderer.setScissor(place * each, 0, each, height);
      renderer.clear(false, true, true);
      renderer.render(this.#scene, this.view.camera);
    });
    this.#drawn += 1;
    this.#sharpness.drew();
  }
}
