/**
 * Copy and paste movements, also between sessions: the browser stores the copied ones.
 */

/** @import {Block} from "../../types.js" */

/**
 * @typedef {{channel: string, start: number, end: number, targets: Record<string, number>, onset: number, offset: number,
 *            function: string, priority: number | null}} Copied a movement whose times count from the first one's start
 */

const KEY = "risorius-movements";

/** Copy the selected movements. @param {import("../controller.js").TimelineController} controller @returns {boolean} whether there are any */
export function copy(controller) {
  const blocks = controller.blocks.filter(({ editable }) => editable);
  if (blocks.length === 0) return false;
  const first = Math.min(...blocks.map(({ start }) => start));
  const own = Object.fromEntries(controller.scene.model.catalogue.channels.map(({ name, priority }) => [name, priority]));
  localStorage.setItem(KEY, JSON.stringify(blocks.map((block) => copied(block, first, own[block.channel]))));
  return true;
}

/** @param {Block} block @param {number} first @param {number} priority @returns {Copied} */
function copied(block, first, priority) {
  const { channel, start, apex_start, apex_end, end, targets } = block;
  return {
    channel,
    start: start - first,
    end: end - first,
    targets,
    onset: apex_start - start,
    offset: end - apex_end,
    function: block.function,
    priority: block.priority === priority ? null : block.priority,
  };
}

/** Return the copied movements; the first one starts at 0. @returns {Copied[]} */
export function clipboard() {
  try {
    const found = JSON.parse(localStorage.getItem(KEY) ?? "[]");
    return Array.isArray(found) ? found : [];
  } catch {
    return [];
  }
}

/**
 * Return the wire's edits that add the copied movements at a time, or earlier if they do not fit.
 * @param {Copied[]} movements @param {number} time @param {number} duration
 */
export function pasted(movements, time, duration) {
  const longest = Math.max(...movements.map(({ end }) => end));
  const from = Math.max(0, Math.min(time, duration - longest));
  return movements.map(({ start, end, ...rest }) => ({ kind: "add", start: from + start, end: from + end, ...rest }));
}
