/** The example page: a text box, a face, and what drives it. */

import { GLTFLoader } from "../vendor/three/GLTFLoader.js";
import { drawnBySoftware, draws3d, NO_3D } from "../stage/software.js";
import * as THREE from "../vendor/three/three.module.min.js";
import { LiveFace, driving, nodeOf } from "./risorius-live.js";

const $ = (id) => document.getElementById(id);
const LIVE = "Live: type the next line while it speaks.";
document.body.classList.toggle("embedded", new URLSearchParams(location.search).has("embedded"));
// After the address's "#": a token, and settings as JSON, those of a studio that shows this page among them.
const given = new URLSearchParams(location.hash.slice(1));
const token = given.get("token") ?? undefined;
const { settings: known, heads } = await (await fetch("about.json")).json();
const asked = Object.entries(JSON.parse(given.get("settings") ?? "{}"));
const settings = Object.fromEntries(asked.filter(([name]) => known.includes(name)));
if (!draws3d()) {
  $("status").textContent = NO_3D;
  throw new Error(NO_3D);
}
const isSoftware = drawnBySoftware();
// Smooth edges cost a processor as much as whole pixels do, and let what lies behind the skin show between triangles.
const renderer = new THREE.WebGLRenderer({ canvas: $("stage"), antialias: !isSoftware, alpha: true });
const camera = new THREE.PerspectiveCamera(20, 1, 0.01, 20);
const scene = new THREE.Scene();
scene.add(new THREE.HemisphereLight(0xffffff, 0x8a7f78, 2.2));
const lamp = new THREE.DirectionalLight(0xffffff, 2.4);
lamp.position.set(1, 1.5, 2);
scene.add(lamp);

const ratio = isSoftware ? 1 : Math.min(devicePixelRatio, 2);
/** Milliseconds between pictures: without a graphics card they cost the time in which sound is taken in. */
const REST = isSoftware ? 250 : 0;
let drawn = 0;

let face = null;
let character = null;
let show = () => {};

/** Put a character on the stage in place of the one that is there. */
async function load(address) {
  const { scene: root } = await new GLTFLoader().loadAsync(address);
  if (character) scene.remove(character);
  character = root;
  scene.add(root);
  show = driving(root);
  aim(root);
}

/** Look at the face: where the eyes are, or else at the upper end of all. */
function aim(root) {
  const box = new THREE.Box3().setFromObject(root);
  const eyes = ["left", "right"].map((side) => nodeOf(root, side)?.getWorldPosition(new THREE.Vector3()));
  const [left, right] = eyes;
  const height = left && right ? 4.6 * left.distanceTo(right) : 0.3 * (box.max.y - box.min.y);
  const centre = left && right ? left.clone().add(right).multiplyScalar(0.5) : box.getCenter(new THREE.Vector3());
  centre.y = left && right ? centre.y - 0.12 * height : box.max.y - 0.5 * height;
  const far = height / 2 / Math.tan(THREE.MathUtils.degToRad(camera.fov / 2));
  camera.position.set(centre.x, centre.y, centre.z + far);
  camera.lookAt(centre);
}

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
  const made = new LiveFace(address.href, { token, settings: { ...settings, head: $("head").value } });
  face = made;
  made.addEventListener("interrupted", ({ detail }) => tell(detail.unsaid ? `Not said: ${detail.unsaid}` : "Silent."));
  made.addEventListener("error", ({ detail }) => tell(detail.message, true));
  made.addEventListener("closed", ({ detail }) => {
    if (face !== made) return;
    face = null;
    if (detail.code !== 1000) tell(made.fault ?? "The server is gone. Say something to connect again.", true);
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

$("form").addEventListener("submit", async (event) => {
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
    tell(fault.message, true);
  }
});
$("interrupt").addEventListener("click", () => face?.interrupt());
$("emotion").addEventListener("change", async () => {
  const chosen = $("emotion").value;
  const speaker = await connected().catch((fault) => tell(fault.message, true));
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
    await load(address);
    tell(`${file.name} is on stage.`);
  } catch {
    tell(`${file.name} cannot be read; expected a .glb or .vrm with ARKit's 52 shapes.`, true);
  } finally {
    URL.revokeObjectURL(address);
  }
});

async function loadHead() {
  tell("Loading the head …");
  try {
    await load(`head.glb?head=${encodeURIComponent($("head").value)}`);
    tell("Say something.");
  } catch {
    tell("The head cannot be loaded; the server's terminal may say why.", true);
  }
}

function draw(now) {
  if (now - drawn < REST) return;
  drawn = now;
  const { clientWidth: width, clientHeight: height } = renderer.domElement;
  const size = renderer.getSize(new THREE.Vector2());
  if (size.x !== width || size.y !== height) {
    renderer.setPixelRatio(ratio);
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
  }
  const frame = face?.frame() ?? null;
  show(frame);
  if ($("caption").textContent !== (frame?.text ?? "")) $("caption").textContent = frame?.text ?? "";
  renderer.render(scene, camera);
}

for (const name of heads) $("head").append(new Option(name, name));
$("head").value = settings.head ?? "standard";
renderer.setAnimationLoop(draw);
await loadHead();
document.body.dataset.ready = "yes";
