/** Captions of the strip cover no mark and no other caption where there is room for that. */
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { captionHeights } from "../src/map/captions";

describe("captions of the strip", () => {
  it("lie above and below their marks in turn", () => {
    const captions = [
      { x: 100, half: 40, markY: 50 },
      { x: 160, half: 40, markY: 50 },
    ];
    const marks = captions.map(({ x, markY }) => ({ x, y: markY }));
    expect(captionHeights(captions, marks, 100)).toEqual([34, 67]);
  });

  it("leave the mark of a neighbour in sight", () => {
    const captions = [
      { x: 174, half: 50, markY: 46 },
      { x: 200, half: 72, markY: 60 },
    ];
    const marks = [
      { x: 174, y: 46 },
      { x: 244, y: 60 },
    ];
    const [first, second] = captionHeights(captions, marks, 110);
    expect(Math.abs(second! - 46)).toBeGreaterThanOrEqual(16);
    expect(Math.abs(second! - first!)).toBeGreaterThanOrEqual(14);
  });

  it("stay on the strip", () => {
    const [y] = captionHeights([{ x: 100, half: 40, markY: 10 }], [{ x: 100, y: 10 }], 100);
    expect(y).toBe(27);
  });

  it("are drawn all the same where there is no room", () => {
    const captions = Array.from({ length: 6 }, () => ({ x: 100, half: 40, markY: 20 }));
    const heights = captionHeights(captions, [{ x: 100, y: 20 }], 40);
    expect(heights.filter(Number.isFinite)).toHaveLength(6);
  });
});
