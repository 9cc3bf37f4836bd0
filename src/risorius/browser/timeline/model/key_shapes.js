/**
 * Shapes of keys in a curve drawn by hand: straight, smooth (with handles), or held until the next. A key is
 * [time, value], or [time, value, shape] with a shape of the wire; handles count seconds and value from the key.
 */

/** @import {Key} from "../../types.js" */
/** @import {KeyShape} from "../../wire.js" */

export const SHAPES = { straight: "Straight", smooth: "Smooth", hold: "Hold" };

/** @param {import("../../wire.js").DrawnCurve} curve @returns {Key[]} its keys with their shapes */
export function keysOf({ keys, shapes = [] }) {
  return keys.map((key, k) => (isStraight(shapes[k]) ? key : [key[0], key[1], shapes[k]]));
}

/** @param {KeyShape | null | undefined} shape */
function isStraight(shape) {
  return !shape || !(shape.before || shape.after || shape.hold);
}

/** Return the fields of the wire's edit for keys with shapes. @param {Key[]} keys */
export function fieldsOf(keys) {
  const bent = keys.some(([, , shape]) => !isStraight(shape));
  return { keys: keys.map(([time, value]) => [time, value]), ...(bent ? { shapes: keys.map(([, , shape]) => shape ?? {}) } : {}) };
}

/** @param {Key} key @returns {keyof SHAPES} */
export function shapeOf([, , shape]) {
  if (shape?.hold) return "hold";
  return shape?.before || shape?.after ? "smooth" : "straight";
}

/**
 * Return the keys with the shape of one changed.
 * @param {Key[]} keys @param {number} index @param {keyof SHAPES} kind @returns {Key[]}
 */
export function shaped(keys, index, kind) {
  const [time, value] = keys[index];
  const shape = { straight: null, smooth: smooth(keys, index), hold: { hold: true } }[kind];
  return replaced(keys, index, shape ? [time, value, shape] : [time, value]);
}

/** @param {Key[]} keys @param {number} index @param {Key} key @returns {Key[]} */
function replaced(keys, index, key) {
  return keys.map((one, k) => (k === index ? key : one));
}

/**
 * Return handles a third of the way to the neighbours, level at a peak or a valley to avoid overshoot.
 * @param {Key[]} keys @param {number} index @returns {KeyShape}
 */
function smooth(keys, index) {
  const [before, [time, value], after] = [keys[index - 1], keys[index], keys[index + 1]];
  const [rise, next] = [before, after].map((other) => (other ? (other[1] - value) / (other[0] - time) : 0));
  const slope = rise * next > 0 ? (2 * rise * next) / (rise + next) : 0;
  /** @param {Key | undefined} other @returns {[number, number] | null} */
  const third = (other) => (other ? [(other[0] - time) / 3, (slope * (other[0] - time)) / 3] : null);
  return { before: third(before), after: third(after), hold: false };
}

/**
 * Return the keys with one handle moved; the opposite handle turns with it unless `apart` is true.
 * @param {Key[]} keys @param {number} index @param {"before" | "after"} side
 * @param {[number, number]} handle seconds and value from the key @param {boolean} apart
 */
export function withHandle(keys, index, side, handle, apart) {
  const [seconds, amount] = handle;
  const [time, value, shape] = keys[index];
  const forward = side === "after";
  /** @type {[number, number]} */
  const bent = [forward ? Math.max(seconds, 0.001) : Math.min(seconds, -0.001), amount];
  const opposite = forward ? "before" : "after";
  const other = shape?.[opposite] ?? null;
  /** @type {[number, number] | null} */
  const turned = other && !apart ? [other[0], (other[0] * bent[1]) / bent[0]] : other;
  return replaced(keys, index, [time, value, { hold: false, [side]: bent, [opposite]: turned }]);
}

/**
 * Return a handle limited to the time between two keys, as the server requires.
 * @param {[number, number]} handle @param {number} span @returns {[number, number]}
 */
function within([seconds, amount], span) {
  const share = Math.min(1, span / Math.max(Math.abs(seconds), 1e-9));
  return [seconds * share, amount * share];
}

/**
 * Trace the curve through keys.
 * @param {Key[]} keys @param {CanvasRenderingContext2D} context @param {(time: number) => number} x
 * @param {(value: number) => number} y
 */
export function traceKeys(context, keys, x, y) {
  keys.forEach(([time, value, shape], k) => {
    if (k === 0) context.moveTo(x(time), y(value));
    const next = keys[k + 1];
    if (!next) return;
    const span = next[0] - time;
    if (shape?.hold) context.lineTo(x(next[0]), y(value));
    if (shape?.hold || (!shape?.after && !next[2]?.before)) {
      context.lineTo(x(next[0]), y(next[1]));
      return;
    }
    const rise = (next[1] - value) / 3;
    const out = shape?.after ? within(shape.after, span) : [span / 3, rise];
    const back = next[2]?.before ? within(next[2].before, span) : [-span / 3, -rise];
    context.bezierCurveTo(x(time + out[0]), y(value + out[1]), x(next[0] + back[0]), y(next[1] + back[1]), x(next[0]), y(next[1]));
  });
}

/** Return the ends of a key's handles. @param {Key} key @returns {{side: "before" | "after", time: number, value: number}[]} */
export function handlesOf([time, value, shape]) {
  const sides = /** @type {("before" | "after")[]} */ (["before", "after"]);
  return sides.flatMap((side) => {
    const handle = shape?.[side];
    return handle ? [{ side, time: time + handle[0], value: value + handle[1] }] : [];
  });
}
