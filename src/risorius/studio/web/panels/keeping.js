/** Keeping the dialled face under a name, as a pose or as an emotion: its file is downloaded. */

import { button, field } from "../parts/fields.js";
import { make } from "../parts/dom.js";
import { download } from "../parts/download.js";

/** @param {object} studio @param {() => {dial: object}} face what is dialled now */
export function mountKeeping(studio, face) {
  const name = make("input", { type: "text", id: "pose-name", maxlength: 60, placeholder: "e.g. wry smile" });
  const keep = async (kind) => {
    if (name.value.trim() === "") {
      name.focus();
      return;
    }
    const { values } = (await studio.actions.ask("dial", { ...face().dial, live: false })) ?? {};
    const file = values && (await studio.actions.ask("name_pose", { name: name.value.trim(), kind, values }));
    if (file) download(file);
  };
  const pose = button("Save as pose", { id: "save-pose", onclick: () => keep("pose") });
  const emotion = button("Save as emotion", { id: "save-emotion", onclick: () => keep("emotion") });
  return make("div", { class: "stack" }, field("Name", name), make("div", { class: "row" }, pose, emotion));
}
