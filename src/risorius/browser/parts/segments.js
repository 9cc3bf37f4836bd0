/** Buttons side by side, one of them pressed. */

import { button } from "./fields.js";
import { make } from "./dom.js";

/**
 * @param {Record<string, string>} options labels by name @param {string} label of the group
 * @param {string} value name of the pressed one @param {(name: string) => void} change
 */
export function segments(options, label, value, change) {
  /** @param {string} chosen */
  const press = (chosen) => {
    for (const it of buttons) it.setAttribute("aria-pressed", String(it.dataset.name === chosen));
  };
  const buttons = Object.entries(options).map(([name, title]) => {
    const act = () => {
      press(name);
      change(name);
    };
    return button(title, { "data-name": name, onclick: act });
  });
  press(value);
  return make("div", { class: "segments", role: "group", "aria-label": label }, ...buttons);
}
