/**
 * The heads on stage: the take's, with that of a comparison beside it, or the dialled one. Each head has a
 * player that follows the clock.
 */

import { told } from "../parts/dom.js";
import { Heads } from "./heads.js";
import { Player } from "./player.js";
import { KINDS, unpackFaces } from "../stage/faces.js";
import { graphics } from "../stage/graphics.js";
import { Stage } from "../stage/stage.js";
/** @import {Face} from "../stage/faces.js" */
/** @import {Take} from "./store.js" */

export class HeadPlayers {
  #store;
  #clock;
  #notify;
  #heads;
  /** @type {(import("../stage/figure.js").Figure | null)[]} */
  #figures = [null, null];
  #players;
  /** The number of heads requested for each place: a late answer must not replace a newer head. */
  #casts = [0, 0];

  /** @param {HTMLCanvasElement} canvas @param {Pick<import("./studio.js").Studio, "store" | "connection" | "clock" | "notify">} studio */
  constructor(canvas, { store, connection, clock, notify }) {
    this.#store = store;
    this.#clock = clock;
    this.#notify = notify;
    const coarse = graphics() === "coarse";
    this.stage = new Stage(canvas, { smooth: !coarse });
    this.#heads = new Heads({ coarse });
    this.#players = [0, 1].map(
      (place) => new Player(connection, clock, (a, b, s) => this.#show(place, a, b, s)),
    );
    connection.on("binary", (buffer) => this.#receive(unpackFaces(buffer)));
    clock.seen = () => this.#players.every((player) => !player.behind);
    const engaged = () => {
      this.stage.playing = clock.playing || store.get("busy") !== "";
    };
    clock.on("state", engaged);
    store.watch(["busy"], engaged);
    store.watch(["catalogue", "take", "choices"], () => this.#cast(0, store.get("take")));
    store.watch(["catalogue", "other"], () => this.#cast(1, store.get("other")));
    store.watch(["preview"], () => {
      this.#players[0].previewing = store.get("preview");
    });
    store.watch(["dial"], () => {
      if (store.get("dial") === null) this.#players[0].update();
    });
  }

  /** The camera. */
  get view() {
    return this.stage.view;
  }

  /** Whether the face of the take has not arrived yet. */
  get behind() {
    return this.#players[0].behind;
  }

  /** The heads at the places of the take and of the comparison; null if a place is empty. */
  get figures() {
    return this.#figures;
  }

  /** The players of the take and of the comparison. */
  get players() {
    return this.#players;
  }

  /** Put the head of a take at its place, and let it follow the take. @param {number} place @param {Take | null} take */
  async #cast(place, take) {
    const cast = ++this.#casts[place];
    if (!this.#store.get("catalogue") || (place === 1 && !take)) {
      this.#leave(place);
      return;
    }
    this.#follow(place, take);
    const choices = place === 0 || !take ? this.#store.get("choices") : take.made.choices;
    try {
      const figure = await this.#heads.get(choices, place);
      if (this.#casts[place] !== cast || this.#figures[place] === figure) return;
      this.#figures[place] = figure;
      this.stage.figures = this.#figures.filter((found) => found !== null);
      this.#players[place].update();
    } catch (error) {
      if (this.#casts[place] === cast) this.#notify(`The head cannot be shown: ${told(error)}`);
    }
  }

  /** @param {number} place @param {Take | null} take */
  #follow(place, take) {
    const player = this.#players[place];
    if (player.take === take) return;
    const { first = 0, last = Infinity } = place === 0 ? (this.#store.get("faces") ?? {}) : {};
    player.load(take, first, last);
  }

  /** @param {number} place */
  #leave(place) {
    this.#players[place].load(null);
    if (this.#figures[place] === null) return;
    this.#figures[place] = null;
    this.stage.figures = this.#figures.filter((found) => found !== null);
  }

  /** @param {ReturnType<typeof unpackFaces>} sent */
  #receive(sent) {
    if (sent.kind === KINDS.dial) {
      if (this.#store.get("dial") !== null) this.#draw(0, sent.faces[0], sent.faces[0], 0);
      return;
    }
    for (const player of this.#players) player.receive(sent);
    this.#clock.begin();
  }

  /** @param {number} place @param {Face} a @param {Face} b @param {number} share */
  #show(place, a, b, share) {
    if (place === 0 && this.#store.get("dial") !== null) return;
    this.#draw(place, a, b, share);
  }

  /**
   * Faces of another length belong to another head: they are late, or early.
   * @param {number} place @param {Face} a @param {Face} b @param {number} share
   */
  #draw(place, a, b, share) {
    const figure = this.#figures[place];
    if (!figure || a.points.length !== figure.coordinates || b.points.length !== figure.coordinates) return;
    if (figure.show(a, b, share)) this.stage.invalidate();
  }
}
