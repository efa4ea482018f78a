// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { addPainter, kEachFrame, kPlotsHz, startPainting } from "../src/view/painting";

/** A display of 60 Hz whose clock the painters move on by what they cost. */
let nowMs = 1000;
let next: ((at: number) => void) | undefined;
let stops: (() => void)[] = [];

beforeEach(() => {
  vi.stubGlobal("requestAnimationFrame", (callback: (at: number) => void) => (next = callback));
  vi.spyOn(performance, "now").mockImplementation(() => nowMs);
  startPainting();
});
afterEach(() => {
  for (const stop of stops) stop();
  stops = [];
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
});

function frames(count: number): number {
  let longest = 0;
  for (let n = 0; n < count; ++n) {
    const begun = nowMs;
    next?.(begun);
    longest = Math.max(longest, nowMs - begun);
    nowMs = Math.max(nowMs, begun + 1000 / 60);
  }
  return longest;
}

/** How often a painter of this cost was asked. */
function painter(hz: number, costMs: number) {
  const seen = { times: 0 };
  const paint = () => {
    ++seen.times;
    nowMs += costMs;
  };
  stops.push(addPainter(paint, hz));
  return seen;
}

test("what fits is painted at its own rate", () => {
  const charts = Array.from({ length: 4 }, () => painter(kPlotsHz, 1));
  frames(60);
  for (const { times } of charts) expect(times).toBeGreaterThanOrEqual(18);
});

test("more charts than a frame holds share it, and what is critical is in each frame", () => {
  const charts = Array.from({ length: 24 }, () => painter(kPlotsHz, 8));
  const stop = painter(kEachFrame, 0.5);
  const longest = frames(240);
  expect(stop.times).toBe(240);
  expect(longest).toBeLessThanOrEqual(0.5 + 10 + 8);
  const times = charts.map((chart) => chart.times);
  expect(Math.min(...times)).toBeGreaterThanOrEqual(Math.max(...times) - 1);
  expect(Math.min(...times)).toBeGreaterThan(10);
});
