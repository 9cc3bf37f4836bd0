// The rules of the page's code beside its types (jsconfig.json).
import js from "@eslint/js";

const BROWSER = [
  "AbortController", "Audio", "Blob", "CSS", "CustomEvent", "DOMException", "DataView", "DecompressionStream", "Event",
  "HTMLElement", "HTMLInputElement", "HTMLMediaElement", "HTMLSelectElement", "HTMLTextAreaElement", "ImageData", "Intl", "MutationObserver", "OffscreenCanvas", "ResizeObserver",
  "Response", "TextDecoder", "URL", "URLSearchParams", "WebSocket", "Worker", "addEventListener", "atob", "cancelAnimationFrame",
  "clearTimeout", "clearInterval", "console", "createImageBitmap", "crypto", "devicePixelRatio", "document", "fetch",
  "getComputedStyle", "history", "innerHeight", "innerWidth", "localStorage", "location", "matchMedia", "navigator",
  "performance", "requestAnimationFrame", "requestIdleCallback", "sessionStorage", "setInterval", "setTimeout", "window",
  "AudioBufferSourceNode", "AudioContext", "EventTarget", "File", "MediaRecorder", "Option", "btoa", "structuredClone", "CanvasRenderingContext2D", "queueMicrotask", "confirm", "Buffer", "TextEncoder", "setImmediate",
]; // prettier-ignore

export default [
  { ignores: ["**/vendor/", "tests/ports/", "tests/studio/", "node_modules/", ".venv/", "docs/", "examples/", "build/"] },
  js.configs.recommended,
  {
    files: ["src/risorius/**/*.js", "tests/browser/*.js"],
    languageOptions: { sourceType: "module", globals: Object.fromEntries(BROWSER.map((name) => [name, "readonly"])) },
    linterOptions: { reportUnusedDisableDirectives: "error" },
    rules: {
      curly: ["error", "multi-line"],
      eqeqeq: "error",
      "no-implicit-globals": "error",
      "no-restricted-properties": [
        "error",
        { property: "innerHTML", message: "Texts of others would be markup: use make, or textContent." },
      ],
      "no-shadow": "error",
      "no-throw-literal": "error",
      "no-unused-vars": ["error", { ignoreRestSiblings: true }],
      "no-var": "error",
      "object-shorthand": "error",
      "prefer-const": ["error", { destructuring: "all" }],
      "require-atomic-updates": "off",
    },
  },
];
