/** Download files of the server, or text of the page. */

import { make } from "./dom.js";

/** @param {{path: string, name: string}} file as the wire's `Download` */
export function download({ path, name }) {
  const link = make("a", { href: path, download: name });
  document.body.append(link);
  link.click();
  link.remove();
}

/** @param {string} text @param {string} name */
export function downloadText(text, name) {
  const path = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
  download({ path, name });
  setTimeout(() => URL.revokeObjectURL(path), 10_000);
}
