/** Labelled controls: each returns its element; those that can be set from outside have a `show` method. */

import { fresh, make, spoken } from "./dom.js";

/** A label beside a control. */
export function field(label, control, { stacked = false, hint = "" } = {}) {
  const inner = control.matches("input, select, textarea") ? control : control.querySelector("input, select");
  if (inner && !inner.id) inner.id = fresh("field");
  const text = make("label", { for: inner?.id, title: hint || null }, label);
  return make("div", { class: stacked ? "field stacked" : "field" }, text, control);
}

/**
 * A choice of one.
 * @param {(string | {name: string, title?: string, description?: string})[]} options
 * @param {{value: any, empty?: string, change: (value: string | null) => void}} about
 *   `empty` is what choosing nothing is called; then null can be chosen
 */
export function choice(options, { value, empty, change }) {
  const list = make("select", { onchange: () => change(list.value === "" ? null : list.value) });
  if (empty !== undefined) list.append(make("option", { value: "" }, empty));
  for (const option of options) {
    const { name, title, description } = typeof option === "string" ? { name: option } : option;
    list.append(make("option", { value: name, title: description ?? null }, title ?? spoken(name)));
  }
  list.show = (now) => {
    list.value = now ?? "";
  };
  list.show(value);
  return list;
}

/** A box to tick. */
export function check(label, { value, change, hint = "" }) {
  const box = make("input", { type: "checkbox", checked: value, onchange: () => change(box.checked) });
  const element = make("label", { class: "check", title: hint || null }, box, make("span", {}, label));
  element.show = (now) => {
    box.checked = now;
  };
  return element;
}

/** A number that is typed. Empty is null where `optional` is true. */
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
  box.show = (now) => {
    if (document.activeElement !== box) box.value = now ?? "";
  };
  box.show(value);
  return box;
}

/**
 * A slider with its number beside it, which can be typed too.
 * @param {{label: string, value: number, low: number, high: number, step?: number,
 *          input: (value: number) => void, change?: (value: number) => void}} about
 *   `input` hears every movement, `change` where it comes to rest
 */
export function slider({ label, value, low, high, step = 0.01, input, change = () => {} }) {
  const bounds = { min: low, max: high, step };
  const places = Math.max(0, Math.ceil(-Math.log10(step)));
  const bar = make("input", { type: "range", ...bounds, "aria-label": label });
  const box = make("input", { type: "number", ...bounds, "aria-label": `${label}, number` });
  const show = (now) => {
    bar.value = now;
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
  element.show = show;
  show(value);
  return element;
}

/** A button. `about` are attributes as for `make`. */
export function button(label, about = {}) {
  return make("button", { type: "button", ...about }, ...[label].flat());
}
