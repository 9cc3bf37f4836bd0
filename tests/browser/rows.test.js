import assert from "node:assert/strict";
import { test } from "node:test";
import { Graphs } from "../../src/risorius/browser/timeline/model/graphs.js";
import { BLOCK, GRAPH, blockBand, bodyRows, headRows, heightOf, rowAt } from "../../src/risorius/browser/timeline/model/rows.js";
import { Shapes } from "../../src/risorius/browser/timeline/model/shape.js";
import { Trace } from "./helpers.js";

const [A, B] = [{ id: "a" }, { id: "b" }];
const NAMES = ["frontalis.left", "frontalis.right"];
/** @type {any} */
const MODEL = {
  speech: {},
  lanes: [{ channel: "lips", count: 1, rows: new Map() }, { channel: "head", count: 3, rows: new Map([[A, 0], [B, 2]]) }],
  liveliest: ["masseter", "frontalis"],
  bases: new Map([["masseter", {}], ["frontalis", {}]]),
  base: (/** @type {string} */ base) => ({ base, names: base === "frontalis" ? NAMES : [base] }),
};

test("rows lie one below the other, without gaps", () => {
  /** @type {{y: number, height: number}[][]} */
  const both = [headRows(MODEL), bodyRows(MODEL, [{ base: "masseter", names: ["masseter"] }], new Set(["head"]))];
  for (const rows of both) {
    rows.reduce((y, row) => {
      assert.equal(row.y, y);
      return y + row.height;
    }, 0);
    assert.equal(rowAt(rows, heightOf(rows) - 1), rows.at(-1));
    assert.equal(rowAt(rows, heightOf(rows)), null);
  }
  assert.equal(headRows({ ...MODEL, speech: null }).length, 1);
});

test("a folded lane has all blocks in one row", () => {
  const open = /** @type {any} */ (bodyRows(MODEL, [], new Set())[1]);
  const folded = /** @type {any} */ (bodyRows(MODEL, [], new Set(["head"]))[1]);
  /** @param {any} row @param {any} block */
  const top = (row, block) => blockBand(row, block)[0];
  assert.equal(top(open, B) - top(open, A), 2 * BLOCK);
  assert.equal(top(folded, B), top(folded, A));
  assert.equal(bodyRows(MODEL, [{ base: "masseter", names: [] }], new Set()).at(-1)?.height, GRAPH);
});

test("graphs are those that move most, until the user chooses", () => {
  let changes = 0;
  const graphs = new Graphs(() => (changes += 1));
  assert.deepEqual(graphs.rows, []);
  graphs.setModel(MODEL, true);
  assert.deepEqual(graphs.bases, ["masseter", "frontalis"]);
  graphs.toggle("masseter");
  graphs.setSide("frontalis", "right");
  assert.deepEqual(graphs.rows, [{ base: "frontalis", names: ["frontalis.right"] }]);
  const other = new Graphs(() => {});
  other.setModel(MODEL, true);
  other.restore(JSON.parse(JSON.stringify({ ...graphs.kept, chosen: ["frontalis", "gone"] })), MODEL);
  assert.deepEqual(other.rows, graphs.rows);
  graphs.reset();
  assert.deepEqual([graphs.has("masseter"), changes], [true, 3]);
});

test("a movement's outline rises, holds and falls", () => {
  const shapes = new Shapes(/** @type {any} */ ({ onset_functions: [{ name: "eased", samples: [0, 0.2, 1] }] }));
  for (const { name, points } of [{ name: "eased", points: 3 }, { name: "unknown", points: 2 }]) {
    const trace = new Trace();
    shapes.trace(/** @type {any} */ (trace), { function: name }, [0, 100, 200, 300], 10, 50);
    assert.deepEqual(trace.calls.slice(0, 1), [["move", 0, 50]]);
    assert.deepEqual(trace.calls.at(-1), ["line", 300, 50]);
    assert.ok(trace.calls.some(([, x, y]) => x === 100 && y === 10) && trace.calls.length >= 2 * points);
  }
});
