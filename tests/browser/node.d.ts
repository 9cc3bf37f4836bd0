// What the tests use of Node, for the checks of their types: its own types would change those of the browser.
declare module "node:test" {
  export const test: any;
  export const mock: any;
}
declare module "node:assert/strict" {
  const assert: any;
  export default assert;
}
declare const Buffer: any;
declare function setImmediate(call: (value?: unknown) => void): void;
