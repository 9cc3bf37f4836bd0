/** Record a line with the microphone, and send it like a chosen recording. */

import { button } from "../parts/fields.js";
import { told } from "../parts/dom.js";

const SUFFIXES = [
  ["webm", ".webm"],
  ["ogg", ".ogg"],
  ["mp4", ".m4a"],
];
/** No processing: filters that make calls clearer change the sound of a voice. */
const PLAIN = { echoCancellation: false, noiseSuppression: false, autoGainControl: false };

/**
 * Return the button that starts and stops recording.
 * @param {import("../studio/studio.js").Studio} studio @param {(file: File) => void} done receives the recording
 * @returns {HTMLElement}
 */
export function recordButton({ clock, notify }, done) {
  /** @type {MediaRecorder | null} */
  let recorder = null;
  let timer = 0;
  const record = button("Record", { id: "record", "aria-pressed": "false", onclick: () => (recorder ? recorder.stop() : begin()) });
  record.title = "Record the line with the microphone; the text in the box is its transcript";
  return record;

  async function begin() {
    clock.pause();
    try {
      const stream = await navigator.mediaDevices.getUserMedia({ audio: PLAIN });
      follow(new MediaRecorder(stream), stream);
    } catch (error) {
      notify(`The microphone cannot be used: ${told(error)}`);
    }
  }

  /** @param {MediaRecorder} own @param {MediaStream} stream */
  function follow(own, stream) {
    /** @type {Blob[]} */
    const parts = [];
    const begun = performance.now();
    recorder = own;
    own.ondataavailable = ({ data }) => parts.push(data);
    own.onstop = () => {
      clearInterval(timer);
      recorder = null;
      for (const track of stream.getTracks()) track.stop();
      show("Record", false);
      const suffix = SUFFIXES.find(([kind]) => own.mimeType.includes(kind))?.[1] ?? ".webm";
      done(new File(parts, `recorded${suffix}`, { type: own.mimeType }));
    };
    own.start();
    const tick = () => show(`Stop, ${Math.floor((performance.now() - begun) / 1000)} s`, true);
    timer = setInterval(tick, 500);
    tick();
  }

  /** @param {string} text @param {boolean} on */
  function show(text, on) {
    record.textContent = text;
    record.setAttribute("aria-pressed", String(on));
  }
}
