/**
 * Browsers set up their sound output at the first playback, which takes long: silence is played as soon
 * as the page is touched, so that the first line does not wait.
 */

const RATE = 8000;
const HEADER = [0x46464952, 36 + RATE / 5, 0x45564157, 0x20746d66, 16, 0x10001, RATE, 2 * RATE, 0x100002, 0x61746164, RATE / 5];

/** Play a tenth of a second of silence at the first touch. */
export function wakeSoundWhenTouched() {
  const names = ["pointerdown", "keydown"];
  const wake = () => {
    for (const name of names) document.removeEventListener(name, wake, true);
    const address = URL.createObjectURL(new Blob([new Uint32Array(HEADER), new Uint8Array(RATE / 5)]));
    const silence = new Audio(address);
    silence.addEventListener("ended", () => URL.revokeObjectURL(address));
    // If the browser refuses, the first line starts the output.
    silence.play().catch(() => {});
  };
  for (const name of names) document.addEventListener(name, wake, true);
}
