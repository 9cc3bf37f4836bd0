/** The session: its name in the address, its state when the socket opens, and what the clock plays. */

import { takeOf } from "./take.js";

const KEY = "risorius-session";
const NAME = /^[a-z0-9][a-z0-9-]{0,39}$/;

/** @returns {string} the session in the address, else the one that was open last, else a new one */
export function sessionName() {
  const asked = location.hash.slice(1);
  const known = localStorage.getItem(KEY) ?? "";
  const name = [asked, known].find((found) => NAME.test(found)) ?? `session-${crypto.randomUUID().slice(0, 8)}`;
  localStorage.setItem(KEY, name);
  history.replaceState(null, "", `#${name}`);
  return name;
}

/** Open the session now and whenever the socket is back, and keep clock and view in step with it. */
export function openSession(studio) {
  const { store, connection, clock, notify } = studio;
  window.addEventListener("hashchange", () => location.reload());
  connection.on("up", () => open(studio).catch((error) => notify(error.message)));
  connection.on("down", () => store.set({ link: "down" }));
  connection.on("saved", ({ error }) => store.set({ saved: error ? `Not saved: ${error}` : "saved" }));
  connection.on("progress", ({ stage, re }) => {
    if (re !== null && store.get("busy")) store.set({ busy: stage });
  });
  store.watch(["take"], () => {
    const take = store.get("take");
    const speech = take?.speech;
    clock.load({ duration: take?.duration ?? 0, fps: take?.rate ?? 30, sound: speech ? speech.sound : null });
  });
}

async function open(studio) {
  const { store, connection } = studio;
  if (!store.get("catalogue")) await loadCatalogue(store);
  const state = await connection.request("open");
  const take = state.take && takeOf(state.take);
  const made = take?.made ?? {};
  store.set({ link: "up", recordings: state.recordings, take, faces: null, ...made });
}

async function loadCatalogue(store) {
  const catalogue = await (await fetch("/api/catalogue")).json();
  store.set({ catalogue, choices: store.get("choices") ?? catalogue.choices });
}
