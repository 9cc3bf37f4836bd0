/** The dials that the catalogue defines, with the value that each reads and changes in the dialled face. */

import { spoken } from "../parts/dom.js";
/** @import {Catalogue, EmotionRow, ParameterRow, UnitRow} from "../wire.js" */
/** @import {DialledFace, Sides} from "../types.js" */

/** Return a face at rest, in the form of the wire's `Dial`. @returns {DialledFace} */
export function emptyFace() {
  return { values: {}, emotions: {} };
}

/**
 * The dials of a kind, in groups.
 * @param {Catalogue} catalogue @param {"muscles" | "units" | "emotions"} kind @param {Sides} side
 * @returns {{title: string, dials: Dial[]}[]}
 * @typedef {{label: string, hint: string, range: {low: number, high: number, neutral: number, step: number},
 *            get: (face: DialledFace) => number, set: (face: DialledFace, value: number) => DialledFace}} Dial
 */
export function groupsOf(catalogue, kind, side) {
  if (kind === "emotions") return [{ title: "", dials: catalogue.emotions.map(emotionDial) }];
  if (kind === "units")
    {return [{ title: "", dials: catalogue.action_units.map((unit) => unitDial(unit, side)) }];}
  /** @type {Map<string, Dial[]>} */
  const groups = new Map();
  for (const parameter of catalogue.parameters) {
    const { group, side: own } = parameter;
    if (own && own !== (side === "both" ? "left" : side)) continue;
    groups.set(group, [...(groups.get(group) ?? []), muscleDial(parameter, side)]);
  }
  return [...groups].map(([title, dials]) => ({ title, dials }));
}

/** @param {ParameterRow} parameter @param {Sides} side @returns {Dial} */
function muscleDial({ name, base, side: own, low, high, neutral, number, unit }, side) {
  const names = !own ? [name] : side === "both" ? [`${base}.left`, `${base}.right`] : [name];
  const label = number === null ? spoken(base) : `${String(number).padStart(2, "0")} ${spoken(base)}`;
  const step = high - low > 2 ? 0.5 : 0.01;
  return {
    label: unit ? `${label}, ${unit}` : label,
    hint: "",
    range: { low, high, neutral, step },
    ...over("values", names, neutral),
  };
}

/**
 * Return the dial of an action unit; one without sides is the same on both.
 * @param {UnitRow} unit @param {Sides} side @returns {Dial}
 */
function unitDial({ name, title, targets, approximate }, side) {
  const sided = Object.keys(targets).some((target) => target.endsWith(".left"));
  const key = side === "both" || !sided ? name : `${name}.${side}`;
  const hint = `${title}${approximate ? " (approximately)" : ""}`;
  return {
    label: `${name} ${title}`,
    hint,
    range: { low: 0, high: 1, neutral: 0, step: 0.01 },
    ...over("values", [key], 0),
  };
}

/** @param {EmotionRow} emotion @returns {Dial} */
function emotionDial({ name, description }) {
  const range = { low: 0, high: 1, neutral: 0, step: 0.01 };
  return { label: spoken(name), hint: description, range, ...over("emotions", [name], 0) };
}

/**
 * Return functions that read and set these names of a part of the face; values at rest are removed.
 * @param {"values" | "emotions"} part @param {string[]} names @param {number} neutral
 * @returns {Pick<Dial, "get" | "set">}
 */
function over(part, names, neutral) {
  return {
    get: (face) => face[part][names[0]] ?? neutral,
    set: (face, value) => {
      const changed = { ...face[part] };
      for (const name of names) {
        if (value === neutral) delete changed[name];
        else changed[name] = value;
      }
      return { ...face, [part]: changed };
    },
  };
}
