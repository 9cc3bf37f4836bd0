/** Save the dialled face under a name, as a pose or an emotion, and download its file. */

import { button } from "../parts/fields.js";
import { make } from "../parts/dom.js";
import { downloadText } from "../parts/download.js";

/** @param {import("../studio/studio.js").Studio} studio @param {() => object} face returns the dialled face */
export function mountKeeping(studio, face) {
  const name = make("input", {
    type: "text",
    id: "pose-name",
    maxlength: 60,
    "aria-label": "Name of the face",
    placeholder: "Name",
  });
  /** @param {"pose" | "emotion"} kind */
  const keep = async (kind) => {
    if (name.value.trim() === "") {
      name.focus();
      return;
    }
    const { values } = (await studio.actions.ask("dial", { ...face(), live: false })) ?? {};
    const file = values && (await studio.actions.ask("save_pose", { name: name.value.trim(), kind, values }));
    if (!file) return;
    downloadText(file.text, file.file);
    const { store } = studio;
    if (kind === "emotion")
      {store.set({ ownEmotions: [...new Set([...store.get("ownEmotions"), file.name])] });}
    else store.set({ poses: { ...store.get("poses"), [file.name]: values } });
  };
  const pose = button("Save pose", { id: "save-pose", onclick: () => keep("pose") });
  const emotion = button("Save emotion", { id: "save-emotion", onclick: () => keep("emotion") });
  return make("div", { class: "keep" }, name, pose, emotion);
}
