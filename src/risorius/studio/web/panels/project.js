/** The project: its file, in and out; exports with their progress. */

import { button, check, choice, field } from "../parts/fields.js";
import { fill, make } from "../parts/dom.js";
import { download } from "../parts/download.js";
import { openProject } from "../dropping.js";

const USUAL = [".mp4", ".glb", ".performance.json"];

/** @param {HTMLElement} element @param {object} studio */
export function mountProject(element, studio) {
  const { store, actions } = studio;
  const file = make("input", {
    type: "file", accept: ".json", class: "unseen", tabindex: "-1", "aria-label": "Project file",
    onchange: () => file.files[0] && openProject(studio, file.files[0]),
  });
  const save = button("Save project", { id: "save-project", onclick: async () => {
    const made = await actions.ask("project");
    if (made) download(made);
  } });
  const open = button("Open project …", { id: "open-project", onclick: () => file.click() });
  const fresh = button("New project", { onclick: () => newProject() });
  const note = make("p", { class: "hint" }, "Everything is saved as you go. A project file opens again exactly, also when dropped on the page.");
  element.append(make("section", { class: "stack" }, make("h3", {}, "Project"), make("div", { class: "row" }, save, open, fresh), file, note));
  store.watch(["take"], () => { save.disabled = store.get("take") === null; });
  const exports = make("section", { class: "stack", id: "exports" });
  element.append(exports);
  let built = false;
  store.watch(["catalogue"], () => {
    if (!store.get("catalogue") || built) return;
    built = true;
    mountExports(exports, studio);
  });
}

function newProject() {
  location.hash = `session-${crypto.randomUUID().slice(0, 8)}`;
}

function mountExports(element, studio) {
  const { store, actions } = studio;
  const catalogue = store.get("catalogue");
  const chosen = new Set(USUAL);
  const look = { size: catalogue.size, style: "realistic", camera: "portrait", light: "studio", quality: "normal" };
  const jobs = make("div", { class: "stack", id: "jobs", "aria-live": "polite" });
  const go = button("Export", { class: "primary", id: "export", onclick: start });
  const boxes = catalogue.outputs.map(({ suffix, description }) => {
    const change = (on) => {
      if (on) chosen.add(suffix);
      else chosen.delete(suffix);
      name();
    };
    const box = check(suffix, { value: chosen.has(suffix), change, hint: description });
    box.dataset.suffix = suffix;
    box.append(make("span", { class: "hint" }, description));
    return box;
  });
  const title = make("input", { type: "text", id: "export-name", value: "performance", maxlength: 60 });
  const pick = (label, key, options) => field(label, choice(options, { value: look[key], change: (v) => { look[key] = v; } }));
  const size = make("input", { type: "text", value: look.size, pattern: "\\d+x\\d+", onchange: () => { look.size = size.value; } });
  const { styles, cameras, lights, qualities } = catalogue.looks;
  const picture = make("details", {}, make("summary", {}, "Picture"), make("div", { class: "stack" },
    field("Size", size), pick("Style", "style", styles), pick("Camera", "camera", cameras), pick("Light", "light", lights), pick("Quality", "quality", qualities)));
  element.append(make("h3", {}, "Export"), field("Name", title), make("div", { class: "outputs" }, ...boxes), picture, make("div", { class: "panel-foot" }, go), jobs);
  store.watch(["take", "link"], name);

  function name() {
    go.textContent = chosen.size === 1 ? `Export ${[...chosen][0]}` : `Export ${chosen.size} files`;
    go.disabled = store.get("take") === null || chosen.size === 0 || store.get("link") !== "up";
  }

  async function start() {
    const suffixes = catalogue.outputs.map(({ suffix }) => suffix).filter((suffix) => chosen.has(suffix));
    const asked = { take: store.get("take").take, suffixes, name: title.value.trim() || "performance", ...look };
    const answer = await actions.ask("export", asked);
    if (answer) jobs.prepend(jobOf(studio, answer.job, suffixes));
  }
}

/** An export under way: its progress, then its files. */
function jobOf({ connection, actions }, job, suffixes) {
  const bar = make("progress", { max: 1, "aria-label": "Progress" });
  const stage = make("span", { class: "hint" }, "Starting …");
  const stop = button("Stop", { onclick: () => actions.ask("cancel_export", { job }) });
  const element = make("div", { class: "job" }, make("p", {}, suffixes.join(" ")), bar, make("div", { class: "row" }, stage, stop));
  const ends = [
    connection.on("progress", (told) => {
      if (told.job !== job) return;
      stage.textContent = told.total ? `${told.stage} ${told.done} of ${told.total}` : told.stage;
      if (told.total) bar.value = told.done / told.total;
      else bar.removeAttribute("value");
    }),
    connection.on("exported", (told) => {
      if (told.job !== job) return;
      ends.forEach((end) => end());
      fill(element, ...(told.error ? [make("p", { class: "hint bad" }, told.error)] : told.files.map(fileLink)));
    }),
  ];
  return element;
}

function fileLink({ path, name }) {
  return make("a", { class: "button", href: path, download: name }, name);
}
