/** Exports: choice of files, picture settings, and exports in progress. */

import { button, check, field } from "../parts/fields.js";
import { fill, make } from "../parts/dom.js";
import { settingRow } from "./choices.js";
/** @import {Studio} from "../studio/studio.js" */
/** @import {Download, OutputRow, ProgressEvent, SettingRow} from "../wire.js" */

const USUAL = [".mp4", ".glb", ".performance.json"];

/** @param {HTMLElement} element @param {import("../studio/studio.js").Studio} studio with its catalogue loaded */
export function mountExports(element, studio) {
  new Exports(element, studio);
}

class Exports {
  #studio;
  #chosen = new Set(USUAL);
  #look;
  #title = make("input", { type: "text", id: "export-name", value: "performance", maxlength: 60 });
  #jobs = make("div", { class: "stack", id: "jobs", "aria-live": "polite" });
  #go = button("Export", { class: "primary", id: "export", onclick: () => this.#start() });

  /** @param {HTMLElement} element @param {Studio} studio */
  constructor(element, studio) {
    this.#studio = studio;
    const { outputs, settings } = studio.store.get("catalogue");
    const pictured = settings.filter(({ exported }) => exported);
    this.#look = Object.fromEntries(pictured.map(({ key, default: usual }) => [key, usual]));
    const boxes = make("div", { class: "outputs" }, ...outputs.map((output) => this.#box(output)));
    const foot = make("div", { class: "panel-foot" }, this.#go);
    element.append(
      make("h2", {}, "Export"),
      this.#jobs,
      field("Name", this.#title),
      boxes,
      this.#picture(pictured),
      foot,
    );
    studio.store.watch(["take", "link"], () => this.#name());
  }

  /** @param {OutputRow} output */
  #box({ suffix, description }) {
    /** @param {boolean} on */
    const change = (on) => {
      if (on) this.#chosen.add(suffix);
      else this.#chosen.delete(suffix);
      this.#name();
    };
    const box = check(suffix, { value: this.#chosen.has(suffix), change });
    box.dataset.suffix = suffix;
    box.append(make("span", { class: "hint" }, description));
    return box;
  }

  /** Return the settings of videos, pictures and avatars. @param {SettingRow[]} settings */
  #picture(settings) {
    const rows = settings.map((setting) => {
      const { element } = settingRow(setting, this.#look[setting.key], (value) => {
        this.#look[setting.key] = value;
      });
      return element;
    });
    return make("details", {}, make("summary", {}, "Picture and avatar"), make("div", { class: "stack" }, ...rows));
  }

  #name() {
    const count = this.#chosen.size;
    const { store } = this.#studio;
    this.#go.textContent = count === 1 ? `Export ${[...this.#chosen][0]}` : `Export ${count} files`;
    this.#go.disabled = store.get("take") === null || count === 0 || store.get("link") !== "up";
  }

  async #start() {
    const { store, actions } = this.#studio;
    const suffixes = store
      .get("catalogue")
      .outputs.map(({ suffix }) => suffix)
      .filter((it) => this.#chosen.has(it));
    const name = this.#title.value.trim() || "performance";
    const answer = await actions.ask("export", {
      take: store.get("take")?.take,
      suffixes,
      name,
      ...this.#look,
    });
    if (!answer) return;
    this.#jobs.prepend(jobOf(this.#studio, answer.job, suffixes));
    this.#jobs.firstElementChild?.scrollIntoView({ block: "nearest" });
  }
}

/**
 * An export in progress: its progress bar, then its files.
 * @param {Studio} studio @param {number} job @param {string[]} suffixes
 */
function jobOf({ connection, actions }, job, suffixes) {
  const bar = make("progress", { max: 1, "aria-label": "Progress" });
  const stage = make("span", { class: "hint" }, "Starting …");
  const stop = button("Stop", { onclick: () => actions.ask("cancel_export", { job }) });
  const element = make(
    "div",
    { class: "job" },
    make("p", {}, suffixes.join(" ")),
    bar,
    make("div", { class: "row" }, stage, stop),
  );
  const ends = [
    connection.on("progress", (told) => told.job === job && showProgress(bar, stage, told)),
    connection.on("exported", (told) => {
      if (told.job !== job) return;
      ends.forEach((end) => end());
      fill(
        element,
        ...(told.error ? [make("p", { class: "hint bad" }, told.error)] : linksOf(told.files)),
      );
    }),
  ];
  return element;
}

/** @param {HTMLProgressElement} bar @param {HTMLElement} label @param {ProgressEvent} told */
function showProgress(bar, label, { stage, done, total }) {
  label.textContent = total ? `${stage} ${done} of ${total}` : stage;
  if (total) bar.value = done / total;
  else bar.removeAttribute("value");
}

/** Return a link to each file, and one to an archive if there are several. @param {Download[]} files */
function linksOf(files) {
  if (files.length < 2) return files.map(fileLink);
  const path = files[0].path.replace(/[^/]*$/, "all.zip");
  return [fileLink({ path, name: "all.zip" }), ...files.map(fileLink)];
}

/** @param {Download} file */
function fileLink({ path, name }) {
  return make("a", { class: "button", href: path, download: name }, name);
}
