/** Light or dark theme: the system's, until the user chooses. */

const KEY = "risorius-theme";
const system = matchMedia("(prefers-color-scheme: dark)");

/** Apply the current theme, and follow the system's changes. */
export function followTheme() {
  apply();
  system.addEventListener("change", apply);
}

/** Switch to the other theme, and remember it. */
export function switchTheme() {
  localStorage.setItem(KEY, theme() === "dark" ? "light" : "dark");
  apply();
}

/** @returns {"light" | "dark"} */
export function theme() {
  const chosen = localStorage.getItem(KEY);
  if (chosen === "dark" || chosen === "light") return chosen;
  return system.matches ? "dark" : "light";
}

function apply() {
  document.documentElement.dataset.theme = theme();
  document.dispatchEvent(new CustomEvent("theme"));
}
