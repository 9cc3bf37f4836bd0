/** A recording in place of a synthesized voice: chosen, or dropped anywhere on the page. */

import { button } from "../parts/fields.js";
import { fill, make, there, told } from "../parts/dom.js";
import { recordButton } from "./microphone.js";
/** @import {Store} from "../studio/store.js" */

const SOUNDS = "audio/*,.wav,.flac,.ogg,.mp3";

/** @param {import("../studio/studio.js").Studio} studio */
export function mountRecording(studio) {
  const { store } = studio;
  const file = make("input", {
    type: "file",
    id: "recording",
    accept: SOUNDS,
    class: "unseen",
    tabindex: "-1",
    "aria-label": "Recording",
    onchange: () => file.files?.[0] && upload(studio, file.files[0]),
  });
  const element = make("div", { class: "recording" });
  const record = recordButton(studio, (sound) => upload(studio, sound));
  const write = () => store.set({ source: { ...store.get("source"), script: recognized(store) } });
  const correct = button("Correct the words", {
    id: "recognized",
    title: "Copy the recognized words into the transcript to correct them",
    onclick: () => {
      write();
      there("script").focus();
    },
  });
  store.watch(["source", "take"], show);
  return make("div", {}, file, element);

  function show() {
    const { recording } = store.get("source");
    if (recording === null) {
      const choose = button("Recording …", { onclick: () => file.click() });
      fill(element, choose, record, make("span", { class: "hint" }, "or drop one here"));
      return;
    }
    const remove = button("Remove", {
      onclick: () => store.set({ source: { ...store.get("source"), recording: null, edges: [] } }),
    });
    const name = make("span", { class: "name", title: recording }, plainName(recording));
    fill(element, name, remove, recognized(store) ? correct : null);
  }
}

/**
 * Return the words recognized in the recording, or "" if a transcript is written.
 * @param {Store} store @returns {string}
 */
function recognized(store) {
  const { script, recording } = store.get("source");
  const take = store.get("take");
  const heard = script.trim() === "" && take?.made.source.recording === recording && take.made.source.script.trim() === "";
  return heard ? (take.speech?.text ?? "") : "";
}

/** Send a recording to the session, and make it the source to perform. @param {import("../studio/studio.js").Studio} studio @param {File} file */
export async function upload({ store, notify, actions }, file) {
  const limit = store.get("catalogue")?.limits.recording ?? Infinity;
  if (file.size > limit) {
    notify(`${file.name} is larger than ${Math.round(limit / 1e6)} MB`);
    return;
  }
  const address = `/api/session/${store.get("session")}/recording?name=${encodeURIComponent(file.name)}`;
  try {
    const { recording } = await actions.during(`Sending ${file.name} …`, async (signal) => {
      const response = await fetch(address, { method: "POST", body: file, signal });
      if (!response.ok) throw new Error((await response.text()).trim());
      return response.json();
    });
    store.set({ source: { ...store.get("source"), recording, format: "text", edges: [] } });
    await actions.perform();
  } catch (error) {
    if (!(error instanceof DOMException && error.name === "AbortError")) notify(told(error));
  }
}

/**
 * Return a recording's original name: the server adds eight digits before the suffix to make names unique.
 * @param {string} recording
 */
function plainName(recording) {
  return recording.replace(/-[0-9a-f]{8}(?=\.\w+$)/, "");
}
