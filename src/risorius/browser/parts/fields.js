/** Labelled controls: each returns its element; controls that code can set have a `show` method. */

import { fresh, make, spoken } from "./dom.js";
/** @import {Attributes, Child} from "../types.js" */

/**
 * A label beside a control.
 * @param {string} label @param {HTMLElement} control @param {{stacked?: boolean, hint?: string}} [about]
 */
export function field(label, control, { stacked = false, hint = "" } = {}) {
  const inner = control.matches("input, select, textarea") ? control : control.querySelector("input, select");
  if (inner && !inner.id) inner.id = fresh("field");
  const text = make("label", { for: inner?.id, title: hint || null }, label);
  return make("div", { class: stacked ? "field stacked" : "field" }, text, control);
}

/**
 * A drop-down list.
 * @param {(string | {name: string, title?: string, description?: string})[]} options
 * @param {{value: any, empty?: string, change: (value: string | null) => void}} about
 *   `empty` is the label of no choice, which gives null; without it one item is always chosen
 */
export function choice(options, { value, empty, change }) {
  const list = make("select", { onchange: () => change(list.value === "" ? null : list.value) });
  if (empty !== undefined) list.append(make("option", { value: "" }, empty));
  for (const option of options) {
    const { name, title, description } = typeof option === "string" ? { name: option } : option;
    list.append(make("option", { value: name, title: description ?? null }, title ?? spoken(name)));
  }
  /** @param {string | null} now */
  const show = (now) => {
    list.value = now ?? "";
  };
  show(value);
  return Object.assign(list, { show });
}

/** A check box. @param {string} label @param {{value: boolean, change: (on: boolean) => void, hint?: string}} about */
export function check(label, { value, change, hint = "" }) {
  const box = make("input", { type: "checkbox", checked: value, onchange: () => change(box.checked) });
  const element = make("label", { class: "check", title: hint || null }, box, make("span", {}, label));
  /** @param {boolean} now */
  const show = (now) => {
    box.checked = now;
  };
  return Object.assign(element, { show });
}

/**
 * A number field. If `optional` is true, empty means null.
 * @param {{value: number | null, low: number | null, high: number | null, step?: number | string, optional?: boolean,
 *          placeholder?: string, change: (value: any) => void}} about `change` receives a number, or null
 */
export function number({ value, low, high, step = "any", optional = false, placeholder = "", change }) {
  const box = make("input", {
    type: "number",
    min: low,
    max: high,
    step,
    placeholder,
    onchange: () => {
      if (box.value === "" && optional) change(null);
      else if (box.value !== "" && box.checkValidity()) change(Number(box.value));
      else box.reportValidity();
    },
  });
  /** @param {number | null} now */
  const show = (now) => {
    if (document.activeElement !== box) box.value = String(now ?? "");
  };
  show(value);
  return Object.assign(box, { show });
}

/**
 * A slider with a number field beside it.
 * @param {{label: string, value: number, low: number, high: number, step?: number,
 *          input: (value: number) => void, change?: (value: number) => void}} about
 *   `input` receives every value while it moves, `change` the final one
 */
export function slider({ label, value, low, high, step = 0.01, input, change = () => {} }) {
  const bounds = { min: low, max: high, step };
  const places = Math.max(0, Math.ceil(-Math.log10(step)));
  const bar = make("input", { type: "range", ...bounds, "aria-label": label });
  const box = make("input", { type: "number", ...bounds, "aria-label": `${label}, number` });
  /** @param {number} now */
  const show = (now) => {
    bar.value = String(now);
    if (document.activeElement !== box) box.value = Number(now).toFixed(places);
  };
  bar.addEventListener("input", () => {
    box.value = Number(bar.value).toFixed(places);
    input(Number(bar.value));
  });
  bar.addEventListener("change", () => change(Number(bar.value)));
  box.addEventListener("change", () => {
    if (box.value === "" || !box.checkValidity()) {
      box.reportValidity();
      return;
    }
    bar.value = box.value;
    input(Number(box.value));
    change(Number(box.value));
  });
  const element = make("div", { class: "slider" }, bar, box);
  show(value);
  return Object.assign(element, { show });
}

/** A button. `about` are attributes as for `make`. @param {Child | Child[]} label @param {Attributes} [about] */
export function button(label, about = {}) {
  return make("button", { type: "button", ...about }, ...[label].flat());
}
