/**
 * Blood in the skin of a moving face, as in `looks/perfusion.py`: compressed skin reddens, stretched
 * skin pales. The haemoglobin of a patch is constant while its area changes. Areas are those of the coarse quads
 * before subdivision (`subdivide.py`), smoothed.
 */

/** @import {StageBlood} from "../wire.js" */

const FINE = 24; // numbers of the index for each of the coarse quads: four quads of two triangles

export class Blood {
  #quads;
  #parents;
  #beside;
  #usual;
  #shown;
  #limits;
  #rounds;
  #areas;
  #between;

  /**
   * @param {Uint32Array} index the skin's triangles @param {Float32Array} points of the skin at rest
   * @param {{flesh: Float32Array, folded: Float32Array}} shown how blood shows at each vertex
   * @param {StageBlood} blood the limits of the gain, and the number of smoothing steps
   */
  constructor(index, points, shown, { least, most, rounds }) {
    this.#shown = shown;
    this.#limits = { least, most };
    this.#rounds = rounds;
    this.#quads = quadsOf(index);
    this.#parents = parentsOf(index, points.length / 3);
    const count = index.reduce((first, vertex, k) => (k % 6 === 1 ? Math.min(first, vertex) : first), Infinity);
    this.#beside = besideOf(this.#quads, count);
    this.#areas = new Float32Array(count);
    this.#between = new Float32Array(count);
    this.#usual = this.#smoothed(points).slice();
  }

  /**
   * @param {Float32Array} points of the skin, before the head turns
   * @param {Float32Array} gained output: gain of blood at each vertex, as a share of the usual
   */
  flow(points, gained) {
    const { flesh, folded } = this.#shown;
    const { least, most } = this.#limits;
    const [gain, usual, parents] = [this.#smoothed(points), this.#usual, this.#parents];
    for (let v = 0; v < gain.length; v++) {
      gain[v] = Math.min(Math.max(usual[v] / Math.max(gain[v], 0.1 * usual[v]) - 1, least), most);
    }
    for (let v = 0, k = 0; v < gained.length; v++, k += 4) {
      if (flesh[v] === 0) continue;
      const more = 0.25 * (gain[parents[k]] + gain[parents[k + 1]] + gain[parents[k + 2]] + gain[parents[k + 3]]);
      gained[v] = flesh[v] * (more > 0 ? folded[v] * more : more);
    }
  }

  /** Return the summed area of the quads around each coarse vertex, smoothed over its neighbours. @param {Float32Array} points */
  #smoothed(points) {
    let [now, next] = [this.#areas, this.#between];
    const { starts, ends } = this.#beside;
    const quads = this.#quads;
    now.fill(0);
    for (let k = 0; k < quads.length; k += 4) {
      const area = areaOf(points, 3 * quads[k], 3 * quads[k + 1], 3 * quads[k + 2], 3 * quads[k + 3]);
      for (let corner = k; corner < k + 4; corner++) now[quads[corner]] += area;
    }
    for (let round = 0; round < this.#rounds; round++) {
      for (let v = 0; v < now.length; v++) {
        let sum = 0;
        for (let k = starts[v]; k < starts[v + 1]; k++) sum += now[ends[k]];
        next[v] = sum;
      }
      [now, next] = [next, now];
    }
    return now;
  }
}

/**
 * Return twice the area of a quad, by its diagonals; the arguments are the indices of its corners' coordinates.
 * @param {Float32Array} points @param {number} a @param {number} b @param {number} c @param {number} d
 */
function areaOf(points, a, b, c, d) {
  const ux = points[c] - points[a];
  const uy = points[c + 1] - points[a + 1];
  const uz = points[c + 2] - points[a + 2];
  const vx = points[d] - points[b];
  const vy = points[d + 1] - points[b + 1];
  const vz = points[d + 2] - points[b + 2];
  const x = uy * vz - uz * vy;
  const y = uz * vx - ux * vz;
  const z = ux * vy - uy * vx;
  return Math.sqrt(x * x + y * y + z * z);
}

/** Return the corners of the coarse quads: each fine quad begins with one. @param {Uint32Array} index */
function quadsOf(index) {
  return Uint32Array.from({ length: (4 * index.length) / FINE }, (_, k) => index[6 * k]);
}

/**
 * Return the four coarse vertices around each vertex: one (repeated) at a corner, two on an edge, four inside a quad.
 * @param {Uint32Array} index @param {number} count of vertices
 */
function parentsOf(index, count) {
  const parents = new Uint32Array(4 * count);
  const known = new Uint8Array(count);
  for (let k = 0; k < index.length; k += 6) {
    const [corner, edge, centre, other] = [index[k], index[k + 1], index[k + 2], index[k + 5]];
    parents.fill(corner, 4 * corner, 4 * corner + 4);
    for (const v of [edge, centre, other]) parents[4 * v + known[v]++] = corner;
  }
  // An edge at the border has one quad alone, and each end once.
  known.forEach((found, v) => found === 2 && parents.copyWithin(4 * v + 2, 4 * v, 4 * v + 2));
  return parents;
}

/**
 * Return the vertices that share a quad with each vertex v, v included: `ends[starts[v]] … ends[starts[v + 1] - 1]`.
 * @param {Uint32Array} quads @param {number} count
 */
function besideOf(quads, count) {
  const sets = Array.from({ length: count }, () => new Set());
  for (let k = 0; k < quads.length; k += 4) {
    for (let a = k; a < k + 4; a++) for (let b = k; b < k + 4; b++) sets[quads[a]].add(quads[b]);
  }
  const starts = new Uint32Array(count + 1);
  sets.forEach(({ size }, v) => (starts[v + 1] = starts[v] + size));
  return { starts, ends: Uint32Array.from(sets.flatMap((set) => [...set])) };
}
