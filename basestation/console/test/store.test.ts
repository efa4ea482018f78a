/**
 * The store: ages grow while nothing comes, a silent base makes everything stale, and the history
 * gives back what was known at a moment.
 */
// SPDX-License-Identifier: Apache-2.0
import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { BaseClock, kSilenceMs } from "../src/store/station_clock";
import { Fields } from "../src/store/fields";
import { History } from "../src/store/history";
import { kNothing } from "../src/store/reading";
import type { FieldInfo } from "../src/wire/messages";
import { Judgement, Quality } from "../src/wire/status";

const field = (id: number, path: string): FieldInfo => ({
  id,
  path,
  group: path.split(".")[0],
  name: path.split(".")[1],
  unit: "",
  kind: "real",
  min: 0,
  max: 1,
  resolution: 0.1,
  period_ms: 100,
});
const kGoodFresh = (Judgement.good << 2) | Quality.fresh;

describe("fields", () => {
  test("never heard is never, not zero", () => {
    const fields = new Fields([field(3, "a.b")]);
    expect(fields.read(0, 1000, false, { ...kNothing })).toEqual(kNothing);
    expect(fields.read(fields.slot("not.there"), 0, false, { ...kNothing })).toEqual(kNothing);
  });

  test("zero is a value", () => {
    const fields = new Fields([field(3, "a.b")]);
    fields.write(3, kGoodFresh, 1, 0, 1000);
    const reading = fields.read(0, 1000, false, { ...kNothing });
    expect(reading).toMatchObject({ value: 0, quality: Quality.fresh, judgement: Judgement.good });
  });

  test("ages grow between frames, and silence takes the colour but not the value", () => {
    const fields = new Fields([field(3, "a.b")]);
    fields.write(3, kGoodFresh, 2, 4.5, 1000);
    expect(fields.read(0, 1300, false, { ...kNothing }).ageMs).toBe(320);
    const reading = fields.read(0, 1700, true, { ...kNothing });
    expect(reading).toMatchObject({
      value: 4.5,
      quality: Quality.stale,
      judgement: Judgement.none,
      ageMs: 720,
    });
  });

  test("silence does not make never into stale", () => {
    const fields = new Fields([field(3, "a.b")]);
    expect(fields.read(0, 9, true, { ...kNothing }).quality).toBe(Quality.never);
  });

  test("arrivals are counted, repetitions are not", () => {
    const fields = new Fields([field(3, "a.b")]);
    // A value a second, in frames every 40 ms.
    for (let t = 0; t < 10_000; t += 40) {
      const age = t % 1000;
      fields.write(3, kGoodFresh, age < 1000 ? Math.floor(age / 10) : 99, 1, t);
    }
    expect(fields.arrivals[0]).toBeGreaterThanOrEqual(9);
    expect(fields.arrivals[0]).toBeLessThanOrEqual(11);
  });

  test("an id that the catalogue does not have is counted", () => {
    const fields = new Fields([field(3, "a.b")]);
    fields.write(4, 0, 0, 1, 0);
    expect(fields.unknownIds).toBe(1);
  });
});

describe("base clock", () => {
  test("runs on between frames and knows silence", () => {
    const clock = new BaseClock();
    expect(clock.isSilent(5)).toBe(true);
    clock.heard(1000, 50);
    expect(clock.nowMs(75)).toBe(1025);
    expect(clock.isSilent(50 + kSilenceMs)).toBe(false);
    expect(clock.isSilent(51 + kSilenceMs)).toBe(true);
  });
});

describe("history", () => {
  const filled = (count: number, rows = 16) => {
    const fields = new Fields([field(3, "a.b")]);
    const history = new History(1, rows);
    for (let n = 0; n < count; ++n) {
      fields.write(3, kGoodFresh, 0, n, 100 * n);
      history.append(fields, 100 * n);
    }
    return { fields, history };
  };

  test("find is the last row at or before the moment, however full the ring is", () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 0, max: 50 }),
        fc.integer({ min: -50, max: 6000 }),
        (count, at) => {
          const { history } = filled(count);
          const kept = Math.min(count, 16);
          const times = Array.from({ length: kept }, (_, n) => 100 * (count - kept + n));
          expect(history.find(at)).toBe(times.filter((t) => t <= at).length - 1);
          expect(history.size).toBe(kept);
        },
      ),
    );
  });

  test("gives back what was known then", () => {
    const { history } = filled(40);
    const reading = history.read(0, history.find(3550), { ...kNothing });
    expect(reading).toMatchObject({ value: 35, quality: Quality.fresh, judgement: Judgement.good });
    expect(history.read(0, -1, { ...kNothing })).toEqual(kNothing);
    expect(history.read(-1, 3, { ...kNothing })).toEqual(kNothing);
  });

  test("a clock that runs backwards starts it anew", () => {
    const { fields, history } = filled(10);
    history.append(fields, 5);
    expect(history.size).toBe(1);
    expect(history.oldestMs()).toBe(5);
  });
});
