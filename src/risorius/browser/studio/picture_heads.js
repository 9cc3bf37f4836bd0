/**
 * The heads on stage without a graphics card, drawn by the server: the take's, with that of a comparison beside it, or
 * the dialled one. Each picture is requested when the previous one has arrived.
 */

import { contextOf, told } from "../parts/dom.js";
import { View } from "../stage/cameras.js";
import { Newest, fetchPicture, pictureQuery } from "../stage/server_pictures.js";
/** @import {Store, Take} from "./store.js" */

export class PictureHeads {
  #canvas;
  #context;
  #store;
  #clock;
  #notify;
  /** @type {{query: string, picture: ImageBitmap | null}[]} by place */
  #shown = [];
  /** @type {Newest<null>} */
  #newest = new Newest(() => this.#draw());
  #fault = "";
  /** Pictures drawn so far. */
  drawn = 0;
  /** The camera. */
  view = new View(() => this.#change());

  /** @param {HTMLCanvasElement} canvas @param {Pick<import("./studio.js").Studio, "store" | "connection" | "clock" | "notify">} studio */
  constructor(canvas, { store, connection, clock, notify }) {
    this.#canvas = canvas;
    this.#context = contextOf(canvas, {});
    this.#store = store;
    this.#clock = clock;
    this.#notify = notify;
    this.view.listen(canvas);
    clock.on("tick", () => this.#change());
    connection.on("up", () => this.#change());
    store.watch(["catalogue", "choices", "take", "other", "dial", "dialled", "preview", "tried"], () => this.#change());
    new ResizeObserver(() => this.#change()).observe(canvas);
  }

  /** Whether the first picture has not arrived yet. */
  get behind() {
    return this.#shown.length === 0;
  }

  /** Whether a picture is requested. */
  get awaits() {
    return this.#newest.busy;
  }

  #change() {
    if (this.#store.get("catalogue") && this.#canvas.clientHeight > 0) this.#newest.ask(null);
  }

  /** The number of heads on stage. */
  get #count() {
    return this.#store.get("other") ? 2 : 1;
  }

  async #draw() {
    for (let place = 0; place < this.#count; place++) {
      const query = this.#query(place);
      if (this.#shown[place]?.query === query) continue;
      try {
        this.#shown[place] = { query, picture: await fetchPicture(query) };
        this.#fault = "";
      } catch (error) {
        // The same picture is not requested again until something changes, and an error is shown once.
        this.#shown[place] = { query, picture: this.#shown[place]?.picture ?? null };
        if (this.#fault !== told(error)) this.#notify(`The head cannot be shown: ${told(error)}`);
        this.#fault = told(error);
      }
    }
    this.#shown.length = this.#count;
    this.#paint();
  }

  /** Return the query for the server. @param {number} place */
  #query(place) {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    const size = { width: width / this.#count, height };
    this.view.fit(size.width, size.height);
    const { camera, state } = this.view;
    const take = this.#store.get(place === 0 ? "take" : "other");
    const choices = place === 0 || !take ? this.#store.get("choices") : take.made.choices;
    const seen = { eye: camera.position.toArray(), target: state.centre, field: camera.fov };
    return pictureQuery(choices, place === 0 ? ownValues(this.#store, this.#clock) : valuesAt(this.#store, take, this.#clock.time), size, seen);
  }

  #paint() {
    const { clientWidth, clientHeight } = this.#canvas;
    const [width, height] = [clientWidth, clientHeight].map((side) => Math.round(side * window.devicePixelRatio));
    Object.assign(this.#canvas, { width, height });
    const each = width / this.#count;
    this.#shown.forEach(({ picture }, place) => picture && this.#put(picture, place * each, each, height));
    this.drawn += 1;
  }

  /**
   * Centre a picture in its part of the stage, at full height: its width may differ slightly from the requested one.
   * @param {ImageBitmap} picture @param {number} left @param {number} width @param {number} height
   */
  #put(picture, left, width, height) {
    const context = this.#context;
    const across = (height * picture.width) / picture.height;
    context.save();
    context.beginPath();
    context.rect(left, 0, width, height);
    context.clip();
    context.drawImage(picture, left + (width - across) / 2, 0, across, height);
    context.restore();
  }
}

/**
 * Return the values of the user's face: of the dials, of an edit being previewed, or of the take.
 * @param {Store} store @param {import("../player/clock.js").Clock} clock
 */
function ownValues(store, clock) {
  const [dialled, tried] = [store.get("dialled"), store.get("tried")];
  if (store.get("dial") && dialled) return store.get("catalogue").parameters.map(({ name }) => dialled[name]);
  return valuesAt(store, store.get("take"), clock.time, !clock.playing && store.get("preview") ? tried : null);
}

/**
 * Return the values of all parameters at a time of a take, or of a face at rest without a take.
 * @param {Store} store @param {Take | null} take @param {number} time
 * @param {Map<string, Float32Array | null> | null} [tried] curves that replace the take's; null for a parameter at rest
 */
function valuesAt(store, take, time, tried = null) {
  const frame = take ? Math.floor(Math.min(time * take.rate + 1e-6, take.frames - 1)) : 0;
  return store.get("catalogue").parameters.map(({ name, neutral }) => {
    const curve = tried?.has(name) ? tried.get(name) : take?.curves[name];
    return curve?.[frame] ?? neutral;
  });
}
