/** Files dropped anywhere on the page: recordings are performed, projects opened. */

import { bringBack, isDraft, putAside } from "./drafts.js";
import { told } from "../parts/dom.js";
import { upload } from "../panels/recording.js";

/** @param {import("./studio.js").Studio} studio */
export function listenToDrops(studio) {
  let depth = 0;
  /** @param {number} by */
  const over = (by) => {
    depth = by === 0 ? 0 : depth + by;
    document.body.toggleAttribute("data-dropping", depth > 0);
  };
  /** @param {DragEvent} event */
  const files = (event) => event.dataTransfer?.types.includes("Files");
  document.addEventListener("dragenter", (event) => files(event) && over(1));
  document.addEventListener("dragleave", (event) => files(event) && over(-1));
  document.addEventListener("dragover", (event) => files(event) && event.preventDefault());
  document.addEventListener("drop", (event) => {
    if (!files(event)) return;
    event.preventDefault();
    over(0);
    for (const file of event.dataTransfer?.files ?? []) {
      if (/\.json$/i.test(file.name)) openProject(studio, file);
      else upload(studio, file);
    }
  });
}

/** Open a project file; it replaces the session's project. @param {import("./studio.js").Studio} studio @param {File} file */
export async function openProject({ store, connection, notify, actions }, file) {
  const limit = store.get("catalogue")?.limits.project ?? Infinity;
  if (file.size > limit) {
    notify(`${file.name} is larger than ${Math.round(limit / 1e6)} MB`);
    return;
  }
  const [written, had] = [isDraft(store), store.get("take") !== null];
  putAside(store);
  try {
    const address = `/api/session/${store.get("session")}/project`;
    const response = await fetch(address, { method: "POST", body: file });
    if (!response.ok) throw new Error((await response.text()).trim());
    connection.reopen();
    if (had) {
      const offer = { label: "Restore", act: () => actions.undoOpening() };
      notify(`Opened ${file.name}. It replaces the previous project.`, offer);
    }
  } catch (error) {
    if (written) bringBack(store);
    notify(told(error));
  }
}
