export function mountPerform(element) { element.textContent = ""; }
