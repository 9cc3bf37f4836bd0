// What the page adds to the browser's own types.
import type { Studio } from "./studio/studio.js";

declare global {
  interface Window {
    studio: Studio; // for the curious, and for tests
    played: object;
  }
}
