/** What stands behind the head: the page's own colours of the stage, from top to bottom. */

import * as THREE from "../vendor/three/three.module.min.js";

const HEIGHT = 256;

/** @param {Element} element whose style has --stage-top and --stage-bottom @returns {THREE.Texture} */
export function backdropOf(element) {
  const style = getComputedStyle(element);
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [1, HEIGHT];
  const context = canvas.getContext("2d");
  const gradient = context.createLinearGradient(0, 0, 0, HEIGHT);
  gradient.addColorStop(0, style.getPropertyValue("--stage-top"));
  gradient.addColorStop(1, style.getPropertyValue("--stage-bottom"));
  context.fillStyle = gradient;
  context.fillRect(0, 0, 1, HEIGHT);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return texture;
}
