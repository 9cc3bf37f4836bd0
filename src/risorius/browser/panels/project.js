/** The project: save and open its file; exports; sessions; sound delay. */

import { button, field, number } from "../parts/fields.js";
import { make } from "../parts/dom.js";
import { download } from "../parts/download.js";
import { openProject } from "../studio/dropping.js";
import { mountExports } from "./exports.js";
import { mountSessions } from "./sessions.js";
/** @import {Studio} from "../studio/studio.js" */

const NOTE =
  "Everything is saved automatically. A project file restores this state exactly; you can also drop it on the page.";

/** @param {HTMLElement} element @param {import("../studio/studio.js").Studio} studio */
export function mountProject(element, studio) {
  const { store } = studio;
  const exports = make("section", { class: "stack", id: "exports" });
  element.append(projectOf(studio), exports, mountSessions(studio), soundOf(studio));
  store.watch(["catalogue"], () => {
    if (store.get("catalogue") && exports.childElementCount === 0) mountExports(exports, studio);
  });
}

/** @param {Studio} studio */
function projectOf(studio) {
  const { store, actions } = studio;
  const file = make("input", {
    type: "file",
    accept: ".json",
    class: "unseen",
    tabindex: "-1",
    "aria-label": "Project file",
  });
  file.addEventListener("change", () => file.files?.[0] && openProject(studio, file.files[0]));
  const keep = async () => {
    const made = await actions.ask("project");
    if (made) download(made);
  };
  const save = button("Save", { id: "save-project", title: "Save the project as a file", onclick: keep });
  const open = button("Open …", {
    id: "open-project",
    title: "Open a project's file",
    onclick: () => file.click(),
  });
  const fresh = button("New", { title: "Start a new project", onclick: begin });
  store.watch(["take"], () => {
    save.disabled = store.get("take") === null;
  });
  const row = make("div", { class: "row" }, save, open, fresh);
  return make(
    "section",
    { class: "stack" },
    make("h2", {}, "Project"),
    row,
    file,
    make("p", { class: "hint" }, NOTE),
  );
}

const LATE =
  "The delay that the browser reports is already included. If the lips still run ahead of the sound, " +
  "as with some wireless headphones, enter the remaining delay.";

/** @param {Studio} studio */
function soundOf({ clock }) {
  /** @param {number | null} late */
  const change = (late) => {
    clock.delay = (late ?? 0) / 1000;
  };
  const late = number({ value: Math.round(1000 * clock.delay), low: 0, high: 1000, step: "10", change });
  late.id = "sound-delay";
  const hint = make("p", { class: "hint" }, LATE);
  return make("section", { class: "stack" }, make("h2", {}, "Sound"), field("Sound delay, ms", late), hint);
}

function begin() {
  location.hash = `session-${crypto.randomUUID().slice(0, 8)}`;
}
