/** A head on the example page's stage, shown in the server's draft pictures if there is no graphics card. */

import { Newest, fetchPicture, pictureQuery } from "../stage/server_pictures.js";
/** @import {Frame} from "./risorius-live.js" */

export class PicturedHead {
  /** The outputs that the server's frames must contain. */
  outputs = ["parameters"];
  #canvas;
  #context;
  #token;
  #head = "standard";
  #query = "";
  /** @type {Newest<string>} */
  #newest = new Newest((query) => this.#draw(query));

  /** @param {HTMLCanvasElement} canvas @param {string} [token] of the server */
  constructor(canvas, token) {
    this.#canvas = canvas;
    this.#context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.#token = token;
  }

  /** Put a head of the server on the stage. @param {string} name */
  async loadHead(name) {
    this.#head = name;
  }

  /** Only browsers draw the user's own characters. @returns {Promise<void>} */
  async load() {
    throw new Error("characters need a graphics card, and this browser has none");
  }

  /** Request the picture of a frame; null: of the face at rest. @param {Frame | null} frame */
  show(frame) {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    const values = frame?.values.parameters ?? null;
    const query = pictureQuery({ head: this.#head }, values, { width, height }, null);
    if (query === this.#query) return;
    this.#query = query;
    this.#newest.ask(query);
  }

  /** @param {string} query */
  async #draw(query) {
    // If the server cannot be reached, the page says so at the next line.
    const picture = await fetchPicture(query, this.#token).catch(() => null);
    if (!picture) return;
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    const share = Math.min(width / picture.width, height / picture.height);
    Object.assign(this.#canvas, { width, height });
    const [across, high] = [share * picture.width, share * picture.height];
    this.#context.drawImage(picture, (width - across) / 2, (height - high) / 2, across, high);
  }
}
