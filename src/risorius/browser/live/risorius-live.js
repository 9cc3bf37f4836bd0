/**
 * A live face in a page: it connects to `risorius serve`, plays the sound and returns the face's current frame.
 *
 * The sound is the clock: `frame()` returns the frame whose sound is playing now. The protocol is
 * described in docs/serve.md of Risorius. No dependencies.
 *
 * @example
 * const face = new LiveFace("ws://127.0.0.1:8766/live", { settings: { head: "mei" } });
 * await face.start(); // call it after a click: browsers play no sound before one
 * face.say("Hello there. ");
 * const show = driving(gltf.scene); // any object of three.js whose morph targets have ARKit's names
 * renderer.setAnimationLoop(() => { show(face.frame()); renderer.render(scene, camera); });
 */

/** Seconds of sound that the page buffers, so that playback does not stall. */
const WAITING = 0.12;
/** Share of its duration by which a silent frame may be extended while the buffer is low. */
const SLOWER = 0.1;
const HEADER = 32;

/**
 * @typedef {ArrayLike<number>} Samples -1 to 1
 * @typedef {Record<string, string[]>} Names of the values of each output, as the server's `started` has them
 * @typedef {object} Wanted
 * @property {number} fps
 * @property {string[]} outputs
 * @property {number} ahead
 * @property {object} [settings]
 * @property {string} [token]
 * @typedef {object} Frame
 * @property {number} index
 * @property {number} time seconds from the face's beginning
 * @property {Record<string, Float32Array>} values of each output: `arkit`, `rotations` …
 * @property {Names} names of the values of each output
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
    /** @type {Wanted} */
    this.wanted = { fps: 30, outputs: ["arkit", "rotations"], ahead: 0.2, ...wanted };
    this.sounds = sound;
    /** @type {Frame[]} */
    this.frames = [];
    /** @type {Set<AudioBufferSourceNode>} */
    this.sources = new Set();
    /** @type {number | null} */
    this.base = null;
    /** @type {Frame | null} */
    this.shown = null;
    /** @type {AudioContext | undefined} */
    this.context = undefined;
    /** @type {WebSocket | undefined} */
    this.socket = undefined;
    /** @type {Names} */
    this.started = {};
    /** @type {string | undefined} */
    this.fault = undefined;
    this.text = "";
    this.forgetting = false;
  }

  /** Connect; resolves with the server's `started`, rejects with its error. */
  start() {
    if (this.sounds) this.context = new AudioContext();
    this.context?.resume();
    const socket = (this.socket = new WebSocket(this.url));
    socket.binaryType = "arraybuffer";
    return new Promise((resolve, reject) => {
      socket.onopen = () => this.send("start", { version: 1, format: "binary", ...this.wanted });
      socket.onclose = ({ code }) => {
        reject(new Error(this.fault ?? `the connection closed (${code})`));
        this.tell("closed", { code });
      };
      socket.onmessage = ({ data }) => {
        if (data instanceof ArrayBuffer) this.take(data);
        else this.hear(JSON.parse(data), resolve);
      };
    });
  }

  /** Add text, cut anywhere. @param {string} text */
  say(text) {
    this.send("say", { text });
  }

  /**
   * Add a chunk of an external voice, which is played instead of the server's.
   *
   * @param {Samples} samples -1 to 1
   * @param {number} rate samples a second
   * @param {{text?: string, words?: [string, number, number][]}} [about] the text of the chunk, if known:
   *   its text, or its words with their start and end in seconds since the voice began, or since `flush`
   */
  voice(samples, rate, about = {}) {
    this.send("say", { ...about, audio: packed(samples), rate });
  }

  /**
   * Look in a direction by name, or at [pitch, yaw] in degrees; null returns the gaze to the face's own control.
   * @param {string | [pitch: number, yaw: number] | null} target
   */
  look(target) {
    const angles = Array.isArray(target) ? { pitch: target[0], yaw: target[1] } : { target };
    this.send("look", angles);
  }

  /** Mark the end of the last sentence, or of the external voice. */
  flush() {
    this.send("flush");
  }

  /** Show an emotion at 0 to 1. @param {string} emotion @param {number} intensity */
  feel(emotion, intensity) {
    this.send("feel", { emotion, intensity });
  }

  /** Stop speaking; the event `interrupted` contains the unspoken text. */
  interrupt() {
    this.send("interrupt");
    this.quiet();
  }

  /** Send a chunk of the other person's speech, for example from a microphone. @param {Samples} samples @param {number} rate */
  listen(samples, rate) {
    this.send("listen", { audio: packed(samples), rate });
  }

  /** End the session after speaking all text that has arrived. */
  close() {
    this.send("close");
  }

  /** Close the connection at once. */
  leave() {
    this.quiet();
    this.socket?.close();
    this.context?.close();
  }

  /** Return the frame whose sound is playing now; null before the first. */
  frame() {
    const now = this.now() - (this.base ?? 0);
    while (this.frames.length > 1 && this.frames[1].time <= now) this.frames.shift();
    const [first] = this.frames;
    if (first && first.time <= now) this.shown = first;
    return this.shown;
  }

  /** @param {string} what @param {object} about */
  send(what, about = {}) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ do: what, ...about }));
  }

  /** @param {any} event of the server @param {(event: any) => void} started */
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

  /** @param {string} kind @param {object} detail */
  tell(kind, detail) {
    this.dispatchEvent(new CustomEvent(kind, { detail }));
  }

  /** Unpack a frame and queue it. @param {ArrayBuffer} buffer */
  take(buffer) {
    const view = new DataView(buffer);
    const index = view.getUint32(4, true);
    const rate = view.getUint32(20, true);
    const [floats, samples] = [view.getUint32(24, true), view.getUint32(28, true)];
    /** @type {Frame["values"]} */
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

  /** Set the start of the face's clock: frames must arrive before their sound plays. @param {Frame} frame */
  place(frame) {
    const now = this.now();
    let base = this.base === null || this.forgetting ? now + WAITING / 2 - frame.time : this.base;
    const waits = frame.time + base - now;
    if (waits < 0) base -= waits;
    else if (waits < WAITING && !frame.text) base += SLOWER / this.wanted.fps;
    this.base = base;
    this.forgetting = false;
  }

  /** @param {Int16Array} sound @param {number} rate @param {number} first of its samples since the face's beginning */
  play(sound, rate, first) {
    if (!this.context || !sound.length) return;
    const buffer = this.context.createBuffer(1, sound.length, rate);
    const channel = buffer.getChannelData(0);
    for (let i = 0; i < sound.length; i++) channel[i] = sound[i] / 32768;
    const source = new AudioBufferSourceNode(this.context, { buffer });
    source.connect(this.context.destination);
    source.onended = () => this.sources.delete(source);
    this.sources.add(source);
    source.start(Math.max(0, (this.base ?? 0) + first / rate));
  }

  /** Drop all frames and sound that have not been played. */
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

  /** Return the clock in seconds: the time of the sound being heard, if there is sound. */
  now() {
    if (this.context?.state !== "running") return performance.now() / 1000;
    return this.context.currentTime - (this.context.outputLatency || this.context.baseLatency || 0);
  }
}

/**
 * Return a function that shows a frame on an object of three.js (or null, which shows nothing).
 *
 * Morph targets are matched by ARKit's names or those of the output `rig`, ignoring case; the head and the
 * eyes by the names of their nodes or bones.
 *
 * @param {any} root an Object3D
 * @returns {(frame: Frame | null) => void}
 */
export function driving(root) {
  /** @type {any[]} */
  const meshes = [];
  root.traverse((/** @type {any} */ object) => {
    if (object.morphTargetDictionary) meshes.push(object);
  });
  const turned = PARTS.map((part) => nodeOf(root, part)).map((object) => ({ object, rest: object?.quaternion.clone() }));
  /** @type {Maps} */
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

/** @typedef {Map<string, [target: number, column: number][]>} Maps */
/** @typedef {"head" | "left" | "right"} Part */

/** @type {Part[]} */
const PARTS = ["head", "left", "right"];
const NODES = {
  head: /^(head|j_bip_c_head)$/,
  left: /^(eye_?left|left_?eye|eye_?l|j_adj_l_faceeye)$/,
  right: /^(eye_?right|right_?eye|eye_?r|j_adj_r_faceeye)$/,
};

/**
 * Return the node or bone that is the `head`, the `left` or the `right` eye; undefined if there is none.
 * @param {any} root an Object3D @param {Part} part
 * @returns {any}
 */
export function nodeOf(root, part) {
  /** @type {any} */
  let found;
  root.traverse((/** @type {any} */ object) => {
    if (NODES[part].test(object.name.toLowerCase().replace(/^mixamorig:?/, ""))) found ??= object;
  });
  return found;
}

/**
 * Return the pairs of morph target and column of a mesh.
 * @param {Maps} maps @param {any} mesh @param {string} output @param {string[]} names
 */
function targets(maps, mesh, output, names) {
  const key = mesh.uuid + output;
  let pairs = maps.get(key);
  if (!pairs) {
    const columns = new Map(names.map((name, column) => [name.toLowerCase(), column]));
    pairs = Object.entries(mesh.morphTargetDictionary).flatMap(([name, target]) => {
      const column = columns.get(name.toLowerCase().replace(/^.*\./, ""));
      return column === undefined ? [] : [[target, column]];
    });
    maps.set(key, pairs);
  }
  return pairs;
}

/**
 * Turn a node: it tilts first, then nods, then turns.
 * @param {{object: any, rest: any}} node @param {Float32Array} angles
 */
function turn({ object, rest }, [yaw, pitch, roll]) {
  if (!object) return;
  object.rotation.set(-pitch, yaw, -roll, "YXZ");
  object.quaternion.premultiply(rest);
}

/** Samples as 16-bit ones in base64. @param {Samples} samples */
function packed(samples) {
  const words = Int16Array.from(samples, (s) => Math.round(Math.max(-1, Math.min(1, s)) * 32767));
  return base64(new Uint8Array(words.buffer));
}

/** @param {Uint8Array} bytes */
function base64(bytes) {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}
