/**
 * How a rival is drawn: seen, carried on and not heard differ in shape, not in colour alone, and
 * the list says the time since it was seen.
 */
// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { closingText, doubt, drawList, kite, seenText } from "../src/map/rivals";
import type { Mate, Rival } from "../src/map/scene";
import type { Palette } from "../src/theme/theme";
import { speedUnit } from "../src/view/speed_unit";

const kSeen: Rival = {
  ...{ x: 0, y: 0, yaw: 0, identity: 12, station: 0, offset: 0, gap: 78, speed: 60, closing: 2 },
  ...{ seenS: 0.1, radius: 0.8, coasts: false, stale: false },
};
const kCoasting = { ...kSeen, seenS: 1.44, coasts: true };
const kUnheard = { ...kSeen, stale: true };
const kColours = { stroke: 2, cars: ["a", "b"], rival: "c", stale: "d", text: "e" } as Palette;

/** A pen that notes what it is told to do; colours are no part of it. */
function drawn(draw: (pen: CanvasRenderingContext2D) => void, widthPx = 500): string[] {
  const calls: string[] = [];
  const pen = new Proxy({} as Record<string, unknown>, {
    get: (_, name) =>
      name === "canvas"
        ? { clientWidth: widthPx }
        : (...given: unknown[]) => void calls.push(`${String(name)} ${given.join()}`),
    set: () => true,
  });
  draw(pen as never);
  return calls;
}

test("the mark tells seen, carried on and not heard apart without a colour", () => {
  const marks = [kSeen, kCoasting, kUnheard].map((rival) =>
    drawn((pen) => kite(pen, 0, 0, 0, rival, kColours)).join(),
  );
  expect(new Set(marks).size).toBe(3);
  expect(marks[0]).toContain("fill");
  expect(marks[0]).not.toContain("stroke");
  expect(marks[1]).toMatch(/setLineDash 3,2.*stroke.*arc.*fill/);
  expect(marks[2]).not.toContain("fill");
});

test("the mark points where the rival drives", () => {
  const calls = drawn((pen) => kite(pen, 5, 6, 0.7, kSeen, kColours));
  expect(calls).toContain("translate 5,6");
  expect(calls).toContain("rotate 0.7");
  const tips = calls
    .filter((c) => c.startsWith("lineTo"))
    .map((c) => Number(/[-\d.]+/.exec(c)![0]));
  expect(Math.max(...tips)).toBeGreaterThan(-Math.min(...tips));
});

test("the circle has its true size, and is left out where the mark hides it or is old", () => {
  const around = (rival: Rival) =>
    drawn((pen) => doubt(pen, 1, 2, rival, { x: 10, y: 20 }, kColours)).filter((c) =>
      c.startsWith("ellipse"),
    );
  expect(around({ ...kSeen, radius: 3 })).toEqual([`ellipse 1,2,30,60,0,0,${2 * Math.PI}`]);
  expect(around({ ...kSeen, radius: 0.1 })).toEqual([]);
  expect(around({ ...kSeen, radius: NaN })).toEqual([]);
  expect(around({ ...kUnheard, radius: 3 })).toEqual([]);
});

test("the list has gap, both speeds and since when, then the other cars of the base", () => {
  speedUnit.value = { ...speedUnit.value, name: "km/h", perMps: 3.6 } as never;
  const mate: Mate = {
    ...{ x: 0, y: 0, yaw: 0, number: 8, order: 2, gap: -40, speed: 50, stale: false },
  };
  const textsOf = (rivals: Rival[], mates: Mate[], widthPx: number) =>
    drawn((pen) => drawList(pen, rivals, mates, kColours), widthPx)
      .filter((c) => c.startsWith("fillText"))
      .map((c) => c.replace(/^fillText |,\d+,\d+$/g, ""))
      .filter(Boolean);
  expect(textsOf([kSeen, kCoasting, kUnheard], [mate], 500)).toEqual([
    ...["#12", "+78 m", "+7 km/h", "216 km/h"],
    ...["#12", "+78 m", "+7 km/h", "216 km/h", "seen 1.4 s ago"],
    ...["#12", "+78 m", "+7 km/h", "216 km/h", "not received"],
    ...["car 8", "\u221240 m", "180 km/h"],
  ]);
  expect(textsOf([kSeen, kCoasting], [], 272)).toEqual([
    ...["#12", "+78 m", "+7 km/h", "216 km/h"],
    ...["#12", "+78 m", "seen 1.4 s ago"],
  ]);
  expect(closingText(NaN)).toBe("");
  expect(seenText(kSeen)).toBe("");
});
