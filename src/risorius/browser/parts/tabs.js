/** Panels behind tabs, one visible; arrow keys go from tab to tab. */

import { button } from "./fields.js";
import { fresh, make } from "./dom.js";

/**
 * @param {HTMLElement} element the element to fill
 * @param {{name: string, label: string, panel: HTMLElement}[]} tabs
 * @param {{label: string, chosen: (name: string) => void}} about
 * @returns {(name: string) => void} opens a panel
 */
export function mountTabs(element, tabs, { label, chosen }) {
  const list = make("div", { role: "tablist", "aria-label": label });
  const heads = new Map();
  for (const tab of tabs) {
    tab.panel.id ||= fresh("tabpanel");
    const head = button(tab.label, { role: "tab", id: fresh("tab"), "aria-controls": tab.panel.id });
    head.addEventListener("click", () => open(tab.name));
    tab.panel.setAttribute("role", "tabpanel");
    tab.panel.setAttribute("aria-labelledby", head.id);
    heads.set(tab.name, head);
    list.append(head);
  }
  list.addEventListener("keydown", (event) => {
    const names = tabs.map((tab) => tab.name);
    const now = names.findIndex((name) => heads.get(name) === document.activeElement);
    const to = { ArrowRight: now + 1, ArrowLeft: now - 1, Home: 0, End: names.length - 1 }[event.key];
    if (to === undefined || now < 0) return;
    event.preventDefault();
    event.stopPropagation();
    const name = names[(to + names.length) % names.length];
    open(name);
    heads.get(name).focus();
  });
  element.append(list, ...tabs.map((tab) => tab.panel));

  /** @param {string} name */
  function open(name) {
    for (const tab of tabs) {
      const here = tab.name === name;
      tab.panel.hidden = !here;
      heads.get(tab.name).setAttribute("aria-selected", String(here));
      heads.get(tab.name).tabIndex = here ? 0 : -1;
    }
    chosen(name);
  }
  return open;
}
