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
  title: path,
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

  test("an arrival is a step back of 15 ms and of three tenths of the age, no less", () => {
    const after = (carriedOnMs: number, code: number) => {
      const fields = new Fields([field(3, "a.b")]);
      fields.write(3, kGoodFresh, 0, 1, 0);
      expect(fields.arrivals[0]).toBe(0);
      fields.write(3, kGoodFresh, code, 1, carriedOnMs);
      return fields.arrivals[0];
    };
    expect([after(24, 1), after(25, 1), after(26, 1)]).toEqual([0, 0, 1]);
    expect([after(1000, 71), after(1000, 70), after(1000, 69)]).toEqual([0, 0, 1]);
  });

  test("an id that the catalogue does not have is counted and changes nothing", () => {
    const fields = new Fields([field(3, "a.b")]);
    fields.write(4, 0, 0, 1, 0);
    fields.write(5, 0, 0, 1, 0);
    expect(fields.unknownIds).toBe(2);
    expect(fields.slotOf(4)).toBe(-1);
    expect(fields.read(0, 0, false, { ...kNothing })).toEqual(kNothing);
  });

  test("a field is found by its path and by its id, up to the last there can be", () => {
    const fields = new Fields([field(65535, "a.b"), field(0, "a.c")]);
    expect(fields.info.map(({ path }) => path)).toEqual(["a.b", "a.c"]);
    expect([fields.slot("a.b"), fields.slot("a.c"), fields.slot("a.d")]).toEqual([0, 1, -1]);
    expect([fields.slotOf(65535), fields.slotOf(0), fields.slotOf(1)]).toEqual([0, 1, -1]);
  });

  test("a reading is all that its entry says", () => {
    const fields = new Fields([field(3, "a.b"), field(4, "a.c")]);
    fields.write(3, Quality.late | (Judgement.warning << 2), 2, 4.5, 1000);
    fields.write(4, Quality.fresh | 32, 0, 1, 1000);
    expect(fields.read(0, 1000, false, { ...kNothing })).toEqual({
      value: 4.5,
      quality: Quality.late,
      judgement: Judgement.warning,
      unknown: false,
      ageMs: 20,
    });
    expect(fields.read(1, 1000, false, { ...kNothing }).unknown).toBe(true);
    // The base's clock, carried on by the browser's, may lie a little behind the entry.
    expect(fields.read(0, 990, false, { ...kNothing }).ageMs).toBe(20);
  });

  test("silence takes the judgement of what was known, and changes nothing of what was not", () => {
    const of = (quality: Quality, silent: boolean) => {
      const fields = new Fields([field(3, "a.b")]);
      fields.write(3, quality | (Judgement.bad << 2), 0, 1, 0);
      const { quality: shown, judgement } = fields.read(0, 0, silent, { ...kNothing });
      return [shown, judgement];
    };
    const all = [Quality.fresh, Quality.late, Quality.stale, Quality.never];
    expect(all.map((quality) => of(quality, true))).toEqual([
      [Quality.stale, Judgement.none],
      [Quality.stale, Judgement.none],
      [Quality.stale, Judgement.none],
      [Quality.never, Judgement.none],
    ]);
    expect(all.map((quality) => of(quality, false))).toEqual([
      [Quality.fresh, Judgement.bad],
      [Quality.late, Judgement.bad],
      [Quality.stale, Judgement.none],
      [Quality.never, Judgement.none],
    ]);
  });

  test("nothing is a value that nobody has said", () => {
    expect(kNothing).toEqual({
      value: NaN,
      quality: Quality.never,
      judgement: Judgement.none,
      unknown: false,
      ageMs: Infinity,
    });
    const fields = new Fields([field(3, "a.b")]);
    expect([fields.value[0], fields.status[0], fields.ageMs[0]]).toEqual([NaN, 3, Infinity]);
  });
});

describe("base clock", () => {
  test("runs on between frames and knows silence", () => {
    const clock = new BaseClock();
    expect(clock.isSilent(5)).toBe(true);
    clock.received(1000, 50);
    expect(clock.nowMs(75)).toBe(1025);
    expect(clock.isSilent(50 + kSilenceMs)).toBe(false);
    expect(clock.isSilent(51 + kSilenceMs)).toBe(true);
  });

  test("stands while the base says so, without being silent", () => {
    const clock = new BaseClock();
    clock.received(1000, 50);
    expect(clock.pauseMs(60)).toBeNull();
    for (let at = 200; at < 2000; at += 100) clock.stands(1002, at - 52, at);
    expect(clock.isSilent(1950)).toBe(false);
    expect(clock.nowMs(1950)).toBe(1002);
    expect(clock.pauseMs(1950)).toBe(1898);
  });

  test("goes on with the next frame, and with the word that it does", () => {
    for (const goOn of [
      (clock: BaseClock) => clock.received(1040, 1250),
      (clock: BaseClock) => clock.stands(1040, 0, 1250),
      (clock: BaseClock) => clock.stands(1000, 0, 1210),
    ]) {
      const clock = new BaseClock();
      clock.stands(1000, 900, 1200);
      goOn(clock);
      expect(clock.pauseMs(1250)).toBeNull();
      expect(clock.nowMs(1260)).toBe(1050);
    }
  });

  test("a frame of the moment at which it stands is no end of the pause", () => {
    const clock = new BaseClock();
    clock.stands(1000, 900, 1200);
    clock.received(1000.0000001, 1240);
    expect(clock.pauseMs(1250)).toBe(950);
    expect(clock.nowMs(1250)).toBeCloseTo(1000);
  });

  test("a base that falls silent while its time stands is silent, and ages grow again", () => {
    const clock = new BaseClock();
    clock.received(1000, 50);
    clock.stands(1000, 200, 250);
    expect(clock.isSilent(250 + kSilenceMs)).toBe(false);
    const at = 251 + kSilenceMs;
    expect(clock.isSilent(at)).toBe(true);
    expect(clock.pauseMs(at)).toBeNull();
    expect(clock.nowMs(at)).toBe(1501);
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
