/** The background behind the head: the stage's colours in the page's style sheet, from top to bottom. */

import * as THREE from "../vendor/three/three.module.min.js";

const BANDS = 96; // more than there are shades between the two colours

/**
 * Bands of colour that are cleared, not drawn: by far the fastest way without a graphics card.
 */
export class Backdrop {
  #colours;

  /** @param {Element} element whose style has --stage-top and --stage-bottom */
  constructor(element) {
    const style = getComputedStyle(element);
    const [top, bottom] = ["--stage-top", "--stage-bottom"].map((name) => channels(style.getPropertyValue(name)));
    this.#colours = Array.from({ length: BANDS }, (_, k) => {
      const share = k / (BANDS - 1);
      const [r, g, b] = bottom.map((low, c) => low + share * (top[c] - low));
      return new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
    });
  }

  /**
   * Fill a part of the picture.
   * @param {THREE.WebGLRenderer} renderer @param {number} x @param {number} width @param {number} height
   * @param {(x: number, y: number, width: number, height: number) => void} cut limits the area to clear
   */
  paint(renderer, x, width, height, cut) {
    // Coordinates are rounded to whole pixels: otherwise rows between bands would be left out.
    const over = Math.ceil(2 / renderer.getPixelRatio());
    this.#colours.forEach((colour, k) => {
      const [from, to] = [k, k + 1].map((at) => Math.round((at * height) / BANDS));
      cut(x, from, width, Math.min(to + over, height) - from);
      renderer.setClearColor(colour);
      renderer.clear(true, false, false);
    });
  }
}

/** Return red, green and blue of a colour of the style sheet, 0 to 1. @param {string} text */
function channels(text) {
  const context = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(1, 1).getContext("2d"));
  context.fillStyle = text;
  context.fillRect(0, 0, 1, 1);
  return [...context.getImageData(0, 0, 1, 1).data.slice(0, 3)].map((value) => value / 255);
}
