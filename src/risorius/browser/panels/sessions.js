/** The sessions of this studio: open, name, copy, delete. */

import { button } from "../parts/fields.js";
import { fill, make, told } from "../parts/dom.js";
/**
 * @typedef {{session: string, title: string, line: string, changed: number, open: boolean}} SessionEntry as
 *   `GET /api/sessions` lists them; `changed` is when, in seconds
 */

const WHEN = { dateStyle: "medium", timeStyle: "short" };

/** @param {import("../studio/studio.js").Studio} studio @returns {HTMLElement} */
export function mountSessions(studio) {
  const { store, notify } = studio;
  const list = make("ul", { class: "sessions" });
  const element = make(
    "section",
    { class: "stack tight", id: "sessions", "aria-label": "Sessions" },
    make("h2", {}, "Sessions"),
    list,
  );
  let asked = 0;
  let shown = ""; // rows are rebuilt only if they change: no button disappears from under the pointer
  store.watch(["tab", "saved", "link"], () => {
    if (store.get("tab") === "project" && store.get("link") === "up" && store.get("saved") === "saved") show();
  });
  return element;

  async function show() {
    const number = ++asked;
    const response = await fetch("/api/sessions").catch(() => null);
    /** @type {SessionEntry[] | null} */
    const sessions = response?.ok ? await response.json() : null;
    if (number !== asked || sessions === null || list.contains(document.activeElement)) return;
    const now = JSON.stringify(sessions.map(({ changed, ...entry }) => entry));
    if (now !== shown) fill(list, ...sessions.map(row));
    shown = now;
    sessions.forEach(({ changed }, k) => {
      const when = /** @type {Element} */ (list.children[k].querySelector(".hint"));
      when.textContent = new Date(1000 * changed).toLocaleString([], /** @type {Intl.DateTimeFormatOptions} */ (WHEN));
    });
  }

  /** @param {SessionEntry} entry */
  function row(entry) {
    const { session, title, line } = entry;
    const here = session === store.get("session");
    const called = title || line || "Untitled";
    const name = make("input", {
      type: "text",
      value: title,
      maxlength: 80,
      placeholder: line || "Untitled",
      "aria-label": `Name of the session “${called}”`,
      onchange: () => act(session, `rename?title=${encodeURIComponent(name.value)}`),
    });
    const open = button(here ? "Open now" : "Open", {
      disabled: here,
      "aria-label": here ? `Open now: the session “${called}”` : `Open the session “${called}”`,
      onclick: () => {
        location.hash = session;
      },
    });
    const copy = button("Copy", {
      "aria-label": `Copy the session “${called}”`,
      onclick: async () => (await act(session, "copy")) && show(),
    });
    const remove = button("Delete", {
      disabled: entry.open,
      title: entry.open ? "Open in a tab" : null,
      "aria-label": `Delete the session “${called}”`,
      onclick: () => drop(session, called),
    });
    const when = make("p", { class: "hint" });
    const tools = make("div", { class: "row" }, open, copy, remove);
    return make("li", { "data-session": session, "aria-current": here ? "true" : null }, name, when, tools);
  }

  /** @param {string} session @param {string} called */
  async function drop(session, called) {
    if (!(await act(session, "delete"))) return;
    leave();
    show();
    const back = async () => (await act(session, "put-back")) && show();
    notify(`Deleted “${called}”.`, { label: "Restore", act: back });
  }

  /** Take the focus from the list, so that it can be refreshed. */
  function leave() {
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
  }

  /** @param {string} session @param {string} what @returns {Promise<boolean>} whether it was done */
  async function act(session, what) {
    try {
      const response = await fetch(`/api/session/${session}/${what}`, { method: "POST" });
      if (!response.ok) throw new Error((await response.text()).trim());
      if (what === "copy") leave();
      return true;
    } catch (error) {
      notify(told(error));
      return false;
    }
  }
}
