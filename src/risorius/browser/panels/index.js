/** The panels at the left, one at a time. */

import { make } from "../parts/dom.js";
import { mountTabs } from "../parts/tabs.js";
import { mountCompare } from "./compare.js";
import { mountDials } from "./dials.js";
import { mountPerform } from "./perform.js";
import { mountProject } from "./project.js";
import { mountRules } from "./rules.js";

/** @type {[string, string, (element: HTMLElement, studio: import("../studio/studio.js").Studio) => void][]} */
const PANELS = [
  ["perform", "Perform", mountPerform],
  ["dials", "Dials", mountDials],
  ["rules", "Rules", mountRules],
  ["compare", "Compare", mountCompare],
  ["project", "Project", mountProject],
];

/** @param {HTMLElement} element @param {import("../studio/studio.js").Studio} studio */
export function mountPanels(element, studio) {
  const tabs = PANELS.map(([name, label]) => ({ name, label, panel: make("div", { id: `panel-${name}` }) }));
  /** @param {string} name */
  const chosen = (name) => studio.store.set({ tab: name });
  const open = mountTabs(element, tabs, { label: "Panels", chosen });
  PANELS.forEach(([, , mount], place) => mount(tabs[place].panel, studio));
  open("perform");
  studio.openTab = open;
}
