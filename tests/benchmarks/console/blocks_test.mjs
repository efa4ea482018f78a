/** How figures of blocks are judged: with made-up figures, and a clock and a host of our own. */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  happenings,
  isDisturbed,
  kBlocks,
  quantileOf,
  rateOf,
  summary,
  withDelays,
  worst,
} from "./blocks.mjs";
import { InVain } from "./rig.mjs";

const part = (disturbed, ...values) => ({ disturbed, values });

test("the best block counts, whatever was disturbed", () => {
  const blocks = [[part(true, 9, 8), part(false, 3)], [part(true, 5)], [part(false, 7)]];
  const of = summary(blocks, worst);
  assert.equal(of.best, 5);
  assert.deepEqual(of.undisturbed, { parts: 2, figure: 7 });
  assert.deepEqual(of.disturbed, { parts: 2, figure: 9 });
  assert.equal(summary(blocks, worst, Math.max).best, 9);
});

test("a machine that was never quiet gives a figure all the same", () => {
  const of = summary([[part(true, 4)], [part(true, 6)]], worst);
  assert.equal(of.best, 4);
  assert.deepEqual(of.undisturbed, { parts: 0, figure: undefined });
  assert.deepEqual(of.disturbed, { parts: 2, figure: 6 });
});

test("a block without a figure is none, and not the best one", () => {
  const counted = (count, from, to) => [{ count, from, to, disturbed: false }];
  const rates = summary([counted(6, 0, 3), [], counted(9, 0, 3)], rateOf("count"));
  assert.equal(rates.best, 2);
  assert.equal(rates.undisturbed.figure, 2.5);
  assert.equal(rates.disturbed.figure, undefined);
  assert.equal(summary([[], [part(false)]], worst).best, undefined);
});

test("what never came is endless, and ends its block", async () => {
  let n = 0;
  const blocks = await happenings(3, () =>
    ++n === 2 ? Promise.reject(new InVain("nothing")) : Promise.resolve(n),
  );
  assert.equal(blocks.length, kBlocks);
  assert.deepEqual(
    blocks[0].map(({ values }) => values[0]),
    [1, Infinity],
  );
  assert.deepEqual(
    blocks[1].map(({ values }) => values[0]),
    [3, 4, 5],
  );
  assert.equal(summary(blocks, worst).best, 5);
  assert.equal(quantileOf(0.5)(blocks[0]), Infinity);
  await assert.rejects(
    happenings(1, () => Promise.reject(new Error("a fault of ours"))),
    /a fault of ours/,
  );
});

test("the host and other programs disturb when they had more than their share", () => {
  const before = { takenMs: 100, othersMs: 5000, at: 20_000 };
  const after = (takenMs, othersMs) => ({
    takenMs: 100 + takenMs,
    othersMs: 5000 + othersMs,
    at: 23_000,
  });
  assert.equal(isDisturbed(before, after(20, 300), 20), false);
  assert.equal(isDisturbed(before, after(30, 0), 20), true);
  assert.equal(isDisturbed(before, after(0, 310), 20), true);
});

test("a happening is looked at from its beginning to its end", async () => {
  let takenMs = 0;
  const steals = [0, 10, 20, 0, 30];
  const blocks = await happenings(
    1,
    () => Promise.resolve((takenMs += steals.shift())),
    () => ({ takenMs, othersMs: 0, at: 0 }),
  );
  assert.deepEqual(
    blocks.map(([{ disturbed }]) => disturbed),
    [false, false, true, false, true],
  );
});

test("delays belong to the window in which the packet left", () => {
  const windows = [
    [
      { from: 0, to: 100, disturbed: false },
      { from: 100, to: 200, disturbed: true },
    ],
  ];
  const left = [
    { number: 10, at: 50 },
    { number: 11, at: 100 },
    { number: 12, at: 250 },
  ];
  const seen = [
    { number: 10, at: 53 },
    { number: 11, at: 140 },
    { number: 12, at: 251 },
  ];
  const [parts] = withDelays(windows, left, [seen, seen]);
  assert.deepEqual(
    parts.map(({ values }) => values),
    [
      [3, 3],
      [40, 40],
    ],
  );
  assert.equal(parts[1].disturbed, true);
});
