/** Places in a text: the wire counts characters (code points), the browser counts UTF-16 units. */

/** @param {string} text @param {number} unit @returns {number} characters before it */
export function characterAt(text, unit) {
  return [...text.slice(0, unit)].length;
}

/** @param {string} text @param {number} character @returns {number} units before it */
export function unitAt(text, character) {
  return [...text].slice(0, character).join("").length;
}

/**
 * Move spans of characters after an edit of the text: they stay on their words, grow with text typed inside,
 * and disappear when all their text is deleted.
 * @template {{first: number | null, last: number | null}} T
 * @param {T[]} spans
 * @param {string} before @param {string} after
 */
export function movedSpans(spans, before, after) {
  const [a, b] = [[...before], [...after]];
  let same = 0;
  while (same < a.length && same < b.length && a[same] === b[same]) same += 1;
  let end = 0;
  while (end < a.length - same && end < b.length - same && a.at(-1 - end) === b.at(-1 - end)) end += 1;
  const [changedTo, by] = [a.length - end, b.length - a.length];
  /** @param {number} place @param {boolean} isLast */
  const moved = (place, isLast) => {
    if (place < same || (place === same && (isLast || changedTo > same))) return place;
    return place >= changedTo ? place + by : isLast ? same : changedTo + by;
  };
  return spans
    .map((span) =>
      span.first === null ? span : { ...span, first: moved(span.first, false), last: moved(span.last ?? 0, true) },
    )
    .filter((span) => span.first === null || (span.last ?? 0) > span.first);
}
