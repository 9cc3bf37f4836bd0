/**
 * A live face in a page: it connects to `risorius serve`, plays the sound, and tells what the face does now.
 *
 * The sound is the clock: `frame()` is the frame whose sound is heard at this moment. The protocol is
 * described in docs/serve.md of Risorius. No dependencies.
 *
 * @example
 * const face = new LiveFace("ws://127.0.0.1:8766/live", { settings: { head: "mei" } });
 * await face.start(); // after a click, so that the browser lets it sound
 * face.say("Hello there. ");
 * const show = driving(gltf.scene); // any object of three.js whose morph targets have ARKit's names
 * renderer.setAnimationLoop(() => { show(face.frame()); renderer.render(scene, camera); });
 */

/** Seconds of sound that wait in the page, so that it does not break off. */
const WAITING = 0.12;
/** Share of its duration by which a silent frame may be held longer while too little waits. */
const SLOWER = 0.1;
const HEADER = 32;

/**
 * @typedef {object} Frame
 * @property {number} index
 * @property {number} time seconds from the face's beginning
 * @property {Record<string, Float32Array>} values of each output: `arkit`, `rotations` …
 * @property {Record<string, string[]>} names of the values of each output
 * @property {string} text the sentence that is being said
 */

/**
 * Events: `sentence` ({text}), `interrupted` ({unsaid}), `error` ({message}), `ended`, `closed` ({code}).
 */
export class LiveFace extends EventTarget {
  /**
   * @param {string} url of the server, `ws://…/live`
   * @param {{fps?: number, outputs?: string[], settings?: object, token?: string, ahead?: number,
   *          sound?: boolean}} [options] as in the message `start`; without `sound` it is silent
   */
  constructor(url, options = {}) {
    super();
    const { sound = true, ...wanted } = options;
    this.url = url;
    this.wanted = { fps: 30, outputs: ["arkit", "rotations"], ahead: 0.2, ...wanted };
    this.sounds = sound;
    this.frames = [];
    this.sources = new Set();
    this.base = null;
    this.shown = null;
    this.text = "";
    this.forgetting = false;
  }

  /** Connect; resolves with the server's `started`, rejects with its error. */
  start() {
    if (this.sounds) this.context = new AudioContext();
    this.context?.resume();
    this.socket = new WebSocket(this.url);
    this.socket.binaryType = "arraybuffer";
    return new Promise((resolve, reject) => {
      this.socket.onopen = () => this.send("start", { version: 1, format: "binary", ...this.wanted });
      this.socket.onclose = ({ code }) => {
        reject(new Error(this.fault ?? `the connection closed (${code})`));
        this.tell("closed", { code });
      };
      this.socket.onmessage = ({ data }) => {
        if (data instanceof ArrayBuffer) this.take(data);
        else this.hear(JSON.parse(data), resolve);
      };
    });
  }

  /** Add text, cut anywhere. */
  say(text) {
    this.send("say", { text });
  }

  /**
   * Add a piece of a voice made elsewhere, which is played instead of ours.
   *
   * @param {Float32Array | number[]} samples -1 to 1
   * @param {number} rate samples a second
   * @param {{text?: string, words?: [string, number, number][]}} [about] what it says, as far as it is known:
   *   its text, or its words with their start and end in seconds since the voice began, or since `flush`
   */
  voice(samples, rate, about = {}) {
    this.send("say", { ...about, audio: packed(samples), rate });
  }

  /** Look in a direction by name, or at [pitch, yaw] in degrees; null gives the looks back to the face. */
  look(target) {
    const angles = Array.isArray(target) ? { pitch: target[0], yaw: target[1] } : { target };
    this.send("look", angles);
  }

  /** End the last sentence, or the voice that waits for its end. */
  flush() {
    this.send("flush");
  }

  /** Show an emotion at 0 to 1. */
  feel(emotion, intensity) {
    this.send("feel", { emotion, intensity });
  }

  /** Fall silent; `interrupted` tells what was not said. */
  interrupt() {
    this.send("interrupt");
    this.quiet();
  }

  /** Hear a piece of what the other says: samples -1 to 1, as of a microphone. */
  listen(samples, rate) {
    this.send("listen", { audio: packed(samples), rate });
  }

  /** Let it say what has arrived, and end. */
  close() {
    this.send("close");
  }

  /** Hang up at once. */
  leave() {
    this.quiet();
    this.socket?.close();
    this.context?.close();
  }

  /** Return the frame that is heard now; null before the first. */
  frame() {
    const now = this.now() - this.base;
    while (this.frames.length > 1 && this.frames[1].time <= now) this.frames.shift();
    const [first] = this.frames;
    if (first && first.time <= now) this.shown = first;
    return this.shown;
  }

  send(what, about = {}) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ do: what, ...about }));
  }

  hear(event, started) {
    if (event.is === "started") {
      this.started = event;
      started(event);
    } else if (event.is === "sentence") {
      this.text = event.text;
      this.tell("sentence", event);
    } else {
      if (event.is === "error") this.fault = event.message;
      if (event.is === "interrupted") this.forget();
      this.tell(event.is, event);
    }
  }

  tell(kind, detail) {
    this.dispatchEvent(new CustomEvent(kind, { detail }));
  }

  /** Take in a packed frame. */
  take(buffer) {
    const view = new DataView(buffer);
    const index = view.getUint32(4, true);
    const rate = view.getUint32(20, true);
    const [floats, samples] = [view.getUint32(24, true), view.getUint32(28, true)];
    const values = {};
    let offset = HEADER;
    for (const output of this.wanted.outputs) {
      const count = this.started[output].length;
      values[output] = new Float32Array(buffer, offset, count);
      offset += 4 * count;
    }
    const frame = { index, time: view.getFloat64(8, true), values, names: this.started, text: this.text };
    const sound = new Int16Array(buffer, HEADER + 4 * floats, samples);
    this.place(frame);
    this.play(sound, rate, Math.round(((index + 1) * rate) / this.wanted.fps) - samples);
    this.frames.push(frame);
  }

  /** Decide when the face's beginning was: frames must come before they are heard. */
  place(frame) {
    const now = this.now();
    if (this.base === null || this.forgetting) this.base = now + WAITING / 2 - frame.time;
    const waits = frame.time + this.base - now;
    if (waits < 0) this.base -= waits;
    else if (waits < WAITING && !frame.text) this.base += SLOWER / this.wanted.fps;
    this.forgetting = false;
  }

  play(sound, rate, first) {
    if (!this.context || !sound.length) return;
    const buffer = this.context.createBuffer(1, sound.length, rate);
    const channel = buffer.getChannelData(0);
    for (let i = 0; i < sound.length; i++) channel[i] = sound[i] / 32768;
    const source = new AudioBufferSourceNode(this.context, { buffer });
    source.connect(this.context.destination);
    source.onended = () => this.sources.delete(source);
    this.sources.add(source);
    source.start(Math.max(0, this.base + first / rate));
  }

  /** Forget what is not heard yet. */
  forget() {
    this.quiet();
    this.frame();
    this.frames = [];
    this.forgetting = true;
  }

  quiet() {
    for (const source of this.sources) source.stop();
    this.sources.clear();
  }

  /** Return the clock in seconds: what is heard now, where there is sound. */
  now() {
    if (this.context?.state !== "running") return performance.now() / 1000;
    return this.context.currentTime - (this.context.outputLatency || this.context.baseLatency || 0);
  }
}

/**
 * Return a function that shows a frame on an object of three.js (or null, which shows nothing).
 *
 * Morph targets are found by ARKit's names, or those of the output `rig`, in whatever case; the head and the
 * eyes by the names of their nodes or bones.
 *
 * @param {object} root an Object3D
 */
export function driving(root) {
  const meshes = [];
  root.traverse((object) => {
    if (object.morphTargetDictionary) meshes.push(object);
  });
  const turned = PARTS.map((part) => nodeOf(root, part)).map((object) => ({ object, rest: object?.quaternion.clone() }));
  const maps = new Map();
  return (frame) => {
    if (!frame) return;
    for (const [output, names] of Object.entries(frame.names)) {
      if (output !== "arkit" && output !== "rig") continue;
      const values = frame.values[output];
      for (const mesh of meshes) {
        for (const [target, column] of targets(maps, mesh, output, names)) {
          mesh.morphTargetInfluences[target] = values[column];
        }
      }
    }
    const { rotations } = frame.values;
    if (rotations) turned.forEach((part, k) => turn(part, rotations.subarray(3 * k, 3 * k + 3)));
  };
}

const PARTS = ["head", "left", "right"];
const NODES = {
  head: /^(head|j_bip_c_head)$/,
  left: /^(eye_?left|left_?eye|eye_?l|j_adj_l_faceeye)$/,
  right: /^(eye_?right|right_?eye|eye_?r|j_adj_r_faceeye)$/,
};

/** Return the node or bone that is the `head`, the `left` or the `right` eye; undefined if there is none. */
export function nodeOf(root, part) {
  let found;
  root.traverse((object) => {
    if (NODES[part].test(object.name.toLowerCase().replace(/^mixamorig:?/, ""))) found ??= object;
  });
  return found;
}

/** Return the pairs of morph target and column of a mesh. */
function targets(maps, mesh, output, names) {
  const key = mesh.uuid + output;
  if (!maps.has(key)) {
    const columns = new Map(names.map((name, column) => [name.toLowerCase(), column]));
    const pairs = Object.entries(mesh.morphTargetDictionary).map(([name, target]) => [
      target,
      columns.get(name.toLowerCase().replace(/^.*\./, "")),
    ]);
    maps.set(key, pairs.filter(([, column]) => column !== undefined));
  }
  return maps.get(key);
}

/** Turn a node: it tilts first, then nods, then turns. */
function turn({ object, rest }, [yaw, pitch, roll]) {
  if (!object) return;
  object.rotation.set(-pitch, yaw, -roll, "YXZ");
  object.quaternion.premultiply(rest);
}

/** Samples -1 to 1 as 16-bit ones in base64. */
function packed(samples) {
  const words = Int16Array.from(samples, (s) => Math.round(Math.max(-1, Math.min(1, s)) * 32767));
  return base64(new Uint8Array(words.buffer));
}

function base64(bytes) {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}
