/** Playing what is written: a line that is not performed yet, or was changed since, is performed first. */

/** @param {object} studio store, clock, actions */
export async function playOrPause({ store, clock, actions }) {
  if (clock.playing) {
    clock.pause();
    return;
  }
  if (changed(store)) {
    if (!(await actions.perform())) return;
    clock.seek(0);
  }
  store.set({ dial: null });
  clock.play();
}

/** Whether playing would do anything. */
export function canPlay(store) {
  return store.get("take") !== null || (written(store) && store.get("link") === "up");
}

function written(store) {
  const { script, recording } = store.get("source");
  return script.trim() !== "" || recording !== null;
}

/** Whether what is written is other than what was performed. */
function changed(store) {
  const made = store.get("take")?.made;
  if (!written(store)) return false;
  const same = (part) => JSON.stringify(made[part]) === JSON.stringify(store.get(part));
  return !made || !same("source");
}
