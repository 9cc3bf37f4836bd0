/** The example page: a text box, a face and the controls that drive it. */

import { graphics } from "../stage/graphics.js";
import { DrawnCharacter } from "./drawn_character.js";
import { PicturedHead } from "./pictured_head.js";
import { LiveFace } from "./risorius-live.js";

/** @param {string} id @returns {any} */
const $ = (id) => document.getElementById(id);
const LIVE = "Live: type the next line while it speaks.";
/** The reason that the status line gives when the server draws the pictures. */
const REASONS = {
  card: "",
  coarse: " The server draws draft pictures.",
  processor: " No graphics card: the server draws draft pictures.",
  none: " This browser has no WebGL 2: the server draws draft pictures.",
};
document.body.classList.toggle("embedded", new URLSearchParams(location.search).has("embedded"));
// The address has a token and settings (JSON) after its "#"; a studio that shows this page passes its own settings.
const given = new URLSearchParams(location.hash.slice(1));
const token = given.get("token") ?? undefined;
const { settings: known, heads } = await (await fetch("about.json")).json();
const asked = Object.entries(JSON.parse(given.get("settings") ?? "{}"));
const settings = Object.fromEntries(asked.filter(([name]) => known.includes(name)));
const drawn = graphics() === "card";
const stage = drawn ? new DrawnCharacter($("stage")) : new PicturedHead($("stage"), token);
$("character").disabled = !drawn;
/** @type {LiveFace | null} */
let face = null;

/** @param {string} text @param {boolean} isFault */
function tell(text, isFault = false) {
  $("status").textContent = text;
  $("status").classList.toggle("fault", isFault);
}

/** Connect, if it is not connected yet. */
async function connected() {
  if (face) return face;
  const address = new URL("live", location.href);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  address.hash = address.search = "";
  const { outputs } = stage;
  const made = new LiveFace(address.href, { token, outputs, settings: { ...settings, head: $("head").value } });
  face = made;
  /** @param {string} kind @param {(detail: any) => void} call */
  const hear = (kind, call) => made.addEventListener(kind, (event) => call(/** @type {CustomEvent} */ (event).detail));
  hear("interrupted", ({ unsaid }) => tell(unsaid ? `Not said: ${unsaid}` : "Silent."));
  hear("error", ({ message }) => tell(message, true));
  hear("closed", ({ code }) => {
    if (face !== made) return;
    face = null;
    if (code !== 1000) tell(made.fault ?? "The connection to the server is closed. Say something to reconnect.", true);
  });
  tell("Connecting …");
  try {
    await made.start();
  } catch (fault) {
    face = null;
    throw fault;
  }
  tell(LIVE);
  return made;
}

$("form").addEventListener("submit", async (/** @type {Event} */ event) => {
  event.preventDefault();
  const text = $("text").value.trim();
  if (!text) return;
  $("text").value = "";
  try {
    const speaker = await connected();
    speaker.say(`${text} `);
    speaker.flush();
    tell(LIVE);
  } catch (fault) {
    $("text").value = text;
    tell(messageOf(fault), true);
  }
});
$("interrupt").addEventListener("click", () => face?.interrupt());
$("emotion").addEventListener("change", async () => {
  const chosen = $("emotion").value;
  const speaker = await connected().catch((fault) => tell(messageOf(fault), true));
  for (const { value } of $("emotion").options) if (value) speaker?.feel(value, value === chosen ? 0.8 : 0);
});
$("head").addEventListener("change", async () => {
  face?.leave();
  face = null;
  await loadHead();
});
$("character").addEventListener("change", async () => {
  const [file] = $("character").files;
  if (!file) return;
  const address = URL.createObjectURL(file);
  try {
    await stage.load(address);
    tell(`${file.name} is loaded.`);
  } catch {
    tell(`${file.name} cannot be read; expected a .glb or .vrm with ARKit's 52 shapes.`, true);
  } finally {
    URL.revokeObjectURL(address);
  }
});

async function loadHead() {
  tell("Loading the head …");
  try {
    await stage.loadHead($("head").value);
    tell(`Say something.${REASONS[graphics()]}`);
  } catch {
    tell("The head cannot be loaded; the server's terminal may say why.", true);
  }
}

/** @param {unknown} fault */
function messageOf(fault) {
  return fault instanceof Error ? fault.message : String(fault);
}

function draw() {
  const frame = face?.frame() ?? null;
  stage.show(frame);
  if ($("caption").textContent !== (frame?.text ?? "")) $("caption").textContent = frame?.text ?? "";
  requestAnimationFrame(draw);
}

for (const name of heads) $("head").append(new Option(name, name));
$("head").value = settings.head ?? "standard";
requestAnimationFrame(draw);
await loadHead();
document.body.dataset.ready = "yes";
