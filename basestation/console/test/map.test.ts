/**
 * The map's geometry on an oval: places lie where station and offset say, gaps go the shorter way.
 */
// SPDX-License-Identifier: Apache-2.0
import fc from "fast-check";
import { expect, test } from "vitest";
import { kLengthM, kTrack, placeAt } from "../../../tests/system/console/drive.mjs";
import { Course, fit } from "../src/map/course";

const course = new Course(kTrack as never);
const station = fc.double({ min: -2 * kLengthM, max: 2 * kLengthM, noNaN: true });

test("a place is where its station and offset are", () => {
  fc.assert(
    fc.property(station, fc.double({ min: -8, max: 8, noNaN: true }), (s, offset) => {
      const [got, want] = [course.place(s, offset), placeAt(s, offset)];
      expect(Math.hypot(got.x - want.x, got.y - want.y)).toBeLessThan(0.25);
    }),
  );
});

test("the gap goes the shorter way round and back again", () => {
  fc.assert(
    fc.property(station, station, (a, b) => {
      const gap = course.gap(a, b);
      expect(Math.abs(gap)).toBeLessThanOrEqual(kLengthM / 2 + 1e-6);
      expect(Math.abs(course.gap(a + gap, b))).toBeLessThan(1e-6);
    }),
  );
});

test("everything fitted lies inside the margin, upright or turned, without distortion", () => {
  for (const [w, h] of [
    [800, 400],
    [300, 700],
    [500, 500],
  ]) {
    const into = fit(kTrack.left, w, h, 20);
    for (const [x, y] of kTrack.left) {
      const p = into.toPixel(x, y);
      expect(p.x).toBeGreaterThan(19.9);
      expect(p.x).toBeLessThan(w - 19.9);
      expect(p.y).toBeGreaterThan(19.9);
      expect(p.y).toBeLessThan(h - 19.9);
    }
    const [a, b] = [into.toPixel(0, 0), into.toPixel(3, 4)];
    expect(Math.hypot(b.x - a.x, b.y - a.y)).toBeCloseTo(5 * into.scale, 6);
    // A car that drives east points where a step east goes.
    const east = into.toPixel(10, 0);
    const angle = into.toAngle(0);
    expect(Math.cos(angle)).toBeCloseTo((east.x - a.x) / (10 * into.scale), 6);
    expect(Math.sin(angle)).toBeCloseTo((east.y - a.y) / (10 * into.scale), 6);
  }
});
