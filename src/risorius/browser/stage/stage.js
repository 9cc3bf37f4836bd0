/**
 * The stage: draws one head, or two side by side, when there is something new to see.
 *
 * Pictures are made no finer than the machine draws in time: `Sharpness` lowers the resolution while frames
 * take too long, and raises it again when the face is at rest.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { Backdrop } from "./backdrop.js";
import { Baked } from "./baked.js";
import { View } from "./cameras.js";
import { drawn } from "./fence.js";
import { Fine } from "./fine.js";
import { Overlay } from "./overlay.js";
import { Sharpness } from "./sharpness.js";
import { drawnBySoftware } from "./software.js";
import { Still } from "./still.js";
import { developAsFilm } from "./tone.js";
/** @import {Cut} from "../types.js" */

export class Stage {
  #canvas;
  #renderer;
  #scene = new THREE.Scene();
  /** @type {import("./figure.js").Figure[]} */
  #figures = [];
  #sharpness;
  /** @type {Backdrop | null} */
  #backdrop = null;
  #asked = false;
  #drawing = false;
  #drawn = 0;
  /** @type {Overlay | null} */
  #overlay = null;
  /** @type {Still | null} */
  #still = null;
  #coarse = false; // whether the line plays as coarsely as it must: it would be unquiet to change to and fro
  #playing = false;
  #size = "";
  /** @type {Baked | null} fine pictures of the line, where no graphics card draws */
  baked = null;
  /** What the heads say, for these pictures. @type {() => import("./baked.js").Line | null} */
  line = () => null;
  /** From where the heads are looked at. */
  view = new View(() => {
    this.baked?.forget();
    this.invalidate();
  });

  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.#canvas = canvas;
    const rough = drawnBySoftware();
    this.#renderer = new THREE.WebGLRenderer({ canvas, alpha: false, antialias: !rough });
    this.#renderer.autoClear = false;
    developAsFilm(this.#renderer);
    if (rough) this.#fineBeside(canvas);
    this.#sharpness = new Sharpness(rough, () => (rough ? this.#makeStill() : this.#ask()));
    this.dress();
    document.addEventListener("theme", () => this.dress());
    this.view.listen(canvas);
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
  }

  /** @param {HTMLCanvasElement} canvas */
  #fineBeside(canvas) {
    const fine = new Fine(this.#renderer, this.#scene);
    const overlay = (this.#overlay = new Overlay(canvas));
    const still = (this.#still = new Still(fine, overlay));
    const [line, seen] = [() => this.line(), () => (still.shown && !this.#playing ? this.#seen() : null)];
    this.baked = new Baked(fine, overlay, { line, seen });
  }

  /** Take up the page's colours. */
  dress() {
    this.#backdrop = new Backdrop(this.#canvas);
    this.baked?.forget();
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
    this.baked?.forget();
    for (const { group } of figures) this.#scene.add(group);
    this.#resize();
  }

  /** Whether the clock runs, or is about to. @param {boolean} playing */
  set playing(playing) {
    if (playing) this.stir();
    if (playing && !this.#playing) this.#coarse = !this.baked?.lasts(this.#frame);
    this.#playing = playing;
    this.#sharpness.playing = playing;
  }

  /** Somebody is about to move something: the fine picture of a head at rest would keep them waiting. */
  stir() {
    if (!this.#still?.shown) this.#still?.stop();
    this.baked?.stop();
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
    this.baked?.forget();
    this.view.fit(width / Math.max(this.#figures.length, 1), height);
    this.invalidate();
  }

  /**
   * Take up the canvas' size, as finely as is drawn now: not before a picture, which that clears.
   * @param {number} width @param {number} height
   */
  #fit(width, height) {
    const { ratio } = this.#sharpness;
    const size = [width, height, ratio].join();
    if (size === this.#size) return;
    this.#size = size;
    this.#renderer.setDrawingBufferSize(width, height, ratio);
  }

  async #makeStill() {
    const [seen, still] = [this.#seen(), this.#still];
    if (!seen || !still) return;
    if (!still.shown && !(await still.make(seen))) return;
    this.baked?.leave();
    this.baked?.later();
  }

  /** The frame whose face is shown, alone; -1 where it is none of a line. */
  get #frame() {
    return this.#figures.length === 1 ? (this.#figures[0].nearest?.frame ?? -1) : -1;
  }

  /** What a fine picture shows; null where there is nobody. @returns {import("./fine.js").Seen | null} */
  #seen() {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0 || this.#figures.length === 0) return null;
    const ratio = this.#sharpness.stillRatio(width * height);
    const [across, high] = [Math.floor(width * ratio), Math.floor(height * ratio)];
    const each = Math.floor(across / this.#figures.length);
    const places = this.#figures.map((figure, k) => ({
      figure,
      x: k * each,
      width: each,
      paint: (/** @type {Cut} */ cut) => this.#backdrop?.paint(this.#renderer, k * each, each, high, cut),
    }));
    return { width: across, height: high, camera: this.view.camera, places };
  }

  /** Show the picture of the face's frame, if there is one. */
  #showBaked() {
    const shown = this.baked !== null && !(this.#playing && this.#coarse) && this.baked.show(this.#frame);
    if (this.#playing && !shown) this.#coarse = true;
    if (shown) this.#drawn += 1;
    return shown;
  }

  #draw() {
    const renderer = this.#renderer;
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    this.baked?.stop();
    this.#still?.leave();
    if (this.#showBaked()) return;
    this.baked?.leave();
    this.#overlay?.hide();
    this.#fit(width, height);
    const each = width / Math.max(this.#figures.length, 1);
    renderer.setScissorTest(true);
    this.#figures.forEach((shown, place) => {
      for (const figure of this.#figures) figure.group.visible = figure === shown;
      shown.ready(this.#sharpness.fine, this.view.camera, height * renderer.getPixelRatio(), renderer);
      renderer.setViewport(place * each, 0, each, height);
      this.#backdrop?.paint(renderer, place * each, each, height, (x, y, w, h) => renderer.setScissor(x, y, w, h));
      renderer.setScissor(place * each, 0, each, height);
      renderer.clear(false, true, true);
      renderer.render(this.#scene, this.view.camera);
    });
    this.#drawn += 1;
    this.#sharpness.drew();
  }
}
