/** How a table of gates ends: its verdict, its exit code, its words. */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { worst } from "./blocks.mjs";
import { verdict } from "./gates.mjs";

const blocks = (...figures) => figures.map((figure) => [{ values: [figure], disturbed: true }]);
const silent = () => {};

async function codeOf(measure) {
  return (await verdict("made-up", measure, silent)).code;
}

test("the exit code is 1 exactly where a gate is missed", async () => {
  assert.equal(await codeOf((gates) => gates.say("a figure", 9, "ms")), 0);
  assert.equal(await codeOf((gates) => gates.askBest("p99", blocks(9, 8, 12), worst, 8, "ms")), 0);
  assert.equal(await codeOf((gates) => gates.askBest("p99", blocks(9, 8.1), worst, 8, "ms")), 1);
  assert.equal(await codeOf((gates) => gates.needBest("rate", blocks(3, 5), worst, 5, "/s")), 0);
  assert.equal(await codeOf((gates) => gates.needBest("rate", blocks(3, 4.9), worst, 5, "/s")), 1);
  assert.equal(await codeOf((gates) => gates.ask("lost", 0, 0, "")), 0);
  assert.equal(await codeOf((gates) => gates.ask("lost", 1, 0, "")), 1);
  assert.equal(await codeOf((gates) => gates.need("charts", 23, 24, "")), 1);
});

test("what was not measured, or never came, misses its gate", async () => {
  assert.equal(await codeOf((gates) => gates.askBest("p99", [[]], worst, 8, "ms")), 1);
  assert.equal(await codeOf((gates) => gates.needBest("rate", [[]], worst, 0, "/s")), 1);
  assert.equal(await codeOf((gates) => gates.askBest("p99", blocks(Infinity), worst, 8, "ms")), 1);
  assert.equal(await codeOf((gates) => gates.ask("p99", NaN, 8, "ms")), 1);
});

test("what keeps it from going on is told with what was measured, and is no pass", async () => {
  const lines = [];
  const { code, file } = await verdict(
    "made-up",
    (gates) => {
      gates.askBest("p99", blocks(3), worst, 8, "ms");
      throw new Error("the base ended with 1");
    },
    (line) => lines.push(line),
  );
  assert.equal(code, 2);
  assert.equal(file.ended, "the base ended with 1");
  assert.equal(file.held, false);
  assert.equal(file.rows.length, 1);
  const said = lines.join("\n");
  assert.match(said, /held +p99 +3\.0 ms, limit 8; undisturbed - \(0\), disturbed 3\.0 \(1\)/);
  assert.match(said, /could not go on: the base ended with 1/);
  assert.match(said, /NOT JUDGED to its end/);
  assert.doesNotMatch(said, /at .*gates_test/, "no stack trace");
});

test("what ends before anything is judged does not say that gates held", async () => {
  const lines = [];
  const { code } = await verdict(
    "x",
    () => Promise.reject(new Error("the base is gone")),
    (line) => lines.push(line),
  );
  assert.equal(code, 2);
  assert.match(lines.at(-1), /NOT JUDGED to its end; no gate was judged until then/);
});

test("table and file name the machine, and count what was missed", async () => {
  const lines = [];
  const { file } = await verdict(
    "made-up",
    (gates) => {
      gates.askBest("p99", blocks(9), worst, 8, "ms");
      gates.ask("lost", 0, 0, "");
    },
    (line) => lines.push(line),
  );
  assert.match(file.machine, /^.+, \d+ cores?, \w+ \d+\.\d+/);
  assert.ok(lines[0].startsWith(file.machine));
  assert.match(lines.at(-1), /^made-up: 1 of its gates MISSED$/);
  assert.equal(file.held, false);
});
