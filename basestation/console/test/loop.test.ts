/**
 * The loop of a replay, from its marks to its turns.
 */
// SPDX-License-Identifier: Apache-2.0
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { marked, turn } from "../src/view/loop";

const at = (now_ms: number, speed = 1) => ({
  begin_ms: 0,
  end_ms: 60_000,
  now_ms,
  speed,
  jumps: 0,
});

describe("loop", () => {
  it("has A, then B, then ends", () => {
    const a = marked(null, at(10_000));
    expect(a).toEqual({ fromMs: 10_000, toMs: null });
    const both = marked(a, at(15_000));
    expect(both).toEqual({ fromMs: 10_000, toMs: 15_000 });
    expect(marked(both, at(12_000))).toBeNull();
  });

  it("turns at its ends, the way that it plays, and nowhere else", () => {
    const loop = { fromMs: 10_000, toMs: 15_000 };
    expect(turn(loop, at(14_999))).toBeNull();
    expect(turn(loop, at(15_000))).toBe(10_000);
    expect(turn(loop, at(10_000, -4))).toBe(15_000);
    expect(turn(loop, at(10_001, -4))).toBeNull();
    expect(turn(loop, at(50_000, 0))).toBeNull(); // who pauses may look elsewhere
    expect(turn({ fromMs: 10_000, toMs: null }, at(50_000))).toBeNull();
    expect(turn(null, at(50_000))).toBeNull();
    expect(turn(loop, null)).toBeNull();
  });

  it("lies within the file, whatever was marked, its end where the file still plays", () => {
    const ms = fc.double({ min: 0, max: 60_000, noNaN: true });
    fc.assert(
      fc.property(ms, ms, (first, second) => {
        const loop = marked(marked(null, at(first)), at(second));
        if (loop === null) return Math.min(first, second) >= 59_800;
        return loop.toMs !== null && loop.fromMs < loop.toMs && loop.toMs <= 59_800;
      }),
    );
  });
});
