/**
 * The order in which triangles are drawn. A machine without a graphics card remembers only the last few vertices that
 * it has worked out, and works out the others again with each triangle that has them.
 *
 * As in Sander, Nehab and Barczak, "Fast triangle reordering for vertex locality and reduced overdraw" (2007).
 */

const REMEMBERED = 40; // fewer than there is room for: that is shared out by the last bits of a vertex' number

/**
 * @param {Uint32Array} index (3m,) @returns {{order: number[], index: Uint32Array}} the vertices that triangles have,
 *   in the order in which these come by them, and the triangles between these: round one vertex, then round one of
 *   those that were met last
 */
export function swept(index) {
  const walk = new Walk(index);
  const found = walk.triangles();
  const places = new Map();
  for (const vertex of found) if (!places.has(vertex)) places.set(vertex, places.size);
  return { order: [...places.keys()], index: Uint32Array.from(found, (vertex) => places.get(vertex)) };
}

class Walk {
  #index;
  #starts;
  #own;
  #left; // triangles of each vertex that are not drawn yet
  #met; // when each vertex was worked out last
  #time = REMEMBERED + 1;
  #cursor = 0;

  /** @param {Uint32Array} index */
  constructor(index) {
    const count = index.reduce((most, vertex) => Math.max(most, vertex), -1) + 1;
    this.#index = index;
    this.#left = new Uint32Array(count);
    this.#met = new Uint32Array(count);
    for (const vertex of index) this.#left[vertex] += 1;
    this.#starts = new Uint32Array(count + 1);
    for (let v = 0; v < count; v++) this.#starts[v + 1] = this.#starts[v] + this.#left[v];
    const free = this.#starts.slice();
    this.#own = new Uint32Array(index.length);
    index.forEach((vertex, k) => (this.#own[free[vertex]++] = Math.floor(k / 3)));
  }

  /** @returns {number[]} the triangles' vertices in the new order of the triangles */
  triangles() {
    const [drawn, found] = [new Uint8Array(this.#index.length / 3), []];
    for (let about = this.#next(), turned = 0; about >= 0; about = this.#nextOf(found, turned)) {
      turned = found.length;
      for (let k = this.#starts[about]; k < this.#starts[about + 1]; k++) {
        const triangle = this.#own[k];
        if (drawn[triangle]++) continue;
        for (const vertex of this.#index.subarray(3 * triangle, 3 * triangle + 3)) this.#meet(vertex, found);
      }
    }
    return found;
  }

  /** @param {number} vertex @param {number[]} found */
  #meet(vertex, found) {
    found.push(vertex);
    this.#left[vertex] -= 1;
    if (this.#time - this.#met[vertex] > REMEMBERED) this.#met[vertex] = this.#time++;
  }

  /**
   * Of those just met the one that will be forgotten soonest, but not before all round it is drawn; -1: no more.
   * @param {number[]} found @param {number} turned
   */
  #nextOf(found, turned) {
    let [best, oldest] = [-1, -1];
    for (const vertex of found.slice(turned)) {
      if (this.#left[vertex] === 0) continue;
      const age = this.#time - this.#met[vertex];
      const worth = age + 2 * this.#left[vertex] <= REMEMBERED ? age : 0;
      if (worth > oldest) [best, oldest] = [vertex, worth];
    }
    for (let k = turned - 1; best < 0 && k >= Math.max(turned - REMEMBERED, 0); k--) {
      if (this.#left[found[k]] > 0) best = found[k];
    }
    return best < 0 ? this.#next() : best;
  }

  #next() {
    while (this.#cursor < this.#left.length && this.#left[this.#cursor] === 0) this.#cursor += 1;
    return this.#cursor < this.#left.length ? this.#cursor : -1;
  }
}
