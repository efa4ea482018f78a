/**
 * Laps compared: the frame of a lap, what is asked for again, and one lap against another place by
 * place. Gaps stay gaps.
 */
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, test } from "vitest";
import { lap as encodeLap } from "../../../tests/system/console/wire.mjs";
import { columnOf, deltaOf, noDeltaText, pointAt, remarkOf } from "../src/pages/laps/comparison";
import type { Compared } from "../src/pages/laps/comparison";
import { reasonText } from "../src/pages/primary/limit_words";
import { LapStore } from "../src/store/laps";
import { lapTimeText, signedText } from "../src/view/format";
import { kLapColumns, readLap } from "../src/wire/laps";
import type { LapPoints, LapRow } from "../src/wire/laps";
import type { FieldInfo } from "../src/wire/messages";

const row = (id: number, more: Partial<LapRow> = {}): LapRow => ({
  id,
  number: id,
  begin_ms: 1000 * id,
  end_ms: 1000 * id + 1000,
  time_s: 1,
  start_seen: true,
  finish_seen: true,
  gap_s: 0,
  ...more,
});

const points = (lap: number, time: number[], speed = time.map(() => 50)): LapPoints => {
  const none = Float32Array.from(time, () => NaN);
  return {
    lap,
    stepM: 5,
    columns: {
      time: Float32Array.from(time),
      speed: Float32Array.from(speed),
      crossTrack: none,
      throttle: none,
      brake: none,
    },
  };
};
const lap = (id: number, time: number[], more: Partial<LapRow> = {}): Compared => ({
  row: row(id, more),
  points: points(id, time),
});

function frame(columns: number[][]): DataView {
  const { buffer, byteOffset, byteLength } = encodeLap(7, columns, { timeMs: 1, stepM: 2.5 });
  return new DataView(buffer, byteOffset, byteLength);
}

describe("the frame of a lap", () => {
  const columns = kLapColumns.map((_, n) => [n, n + 0.5, NaN]);

  test("is read column by column", () => {
    const read = readLap(frame(columns))!;
    expect(read).toMatchObject({ lap: 7, stepM: 2.5 });
    kLapColumns.forEach((name, n) => expect([...read.columns[name]]).toEqual(columns[n]));
  });

  test("may have more columns, and is refused with fewer or cut", () => {
    expect(readLap(frame([...columns, [9, 9, 9]]))!.columns.brake[0]).toBe(4);
    expect(readLap(frame(columns.slice(1)))).toBeNull();
    const { buffer, byteOffset, byteLength } = frame(columns);
    expect(readLap(new DataView(buffer, byteOffset, byteLength - 1))).toBeNull();
    expect(readLap(new DataView(buffer, byteOffset, 30))).toBeNull();
  });
});

describe("the laps of a car", () => {
  const store = () => {
    const laps = new LapStore();
    const rows = [row(1, { time_s: null }), row(2), row(3, { end_ms: null, time_s: null })];
    laps.table.value = { length_m: 100, step_m: 5, best: 2, laps: rows };
    return laps;
  };

  test("the reference is the best one until another is chosen", () => {
    const laps = store();
    expect(laps.referenceRow.value?.id).toBe(2);
    laps.reference.value = 1;
    expect(laps.referenceRow.value?.id).toBe(1);
    laps.reference.value = 77;
    expect(laps.referenceRow.value?.id, "one that was dropped").toBe(2);
  });

  test("the lap of a moment is the last that has begun", () => {
    const laps = store();
    expect([999, 1000, 2500, 9e9].map((ms) => laps.rowAt(ms)?.id)).toEqual([undefined, 1, 2, 3]);
  });

  test("a lap that grows is asked for again, one that is over is not", () => {
    const laps = store();
    const asked: number[] = [];
    const want = (id: number, ms: number) =>
      laps.want(laps.row(id)!, ms, (which) => asked.push(which) > 0);
    want(3, 0);
    want(3, 400);
    laps.take(points(3, [0]), 3500, false);
    want(3, 600);
    expect(asked).toEqual([3, 3]);
    expect(laps.points(3)?.lap, "what was here stays until more comes").toBe(3);
    want(2, 0);
    laps.take(points(2, [0]), 3500, false);
    want(2, 600);
    laps.take(points(2, [0]), 4100, false);
    want(2, 5000);
    expect(asked, "its last points may have come later").toEqual([3, 3, 2, 2]);
    want(1, 0);
    laps.take(points(1, [0]), 0, true);
    want(1, 5000);
    expect(asked, "of a recording all is there").toEqual([3, 3, 2, 2, 1]);
  });

  test("what nobody asked for is not kept, and another base has other laps", () => {
    const laps = store();
    laps.take(points(2, [0]), 9e9, false);
    expect(laps.points(2)).toBeNull();
    laps.want(laps.row(2)!, 0, () => true);
    laps.take(points(2, [0]), 9e9, false);
    laps.forget();
    expect(laps.points(2)).toBeNull();
    expect(laps.row(2)).toBeNull();
  });
});

describe("one lap against another", () => {
  test("the delta is the later time at the same place, and a gap of either is a gap", () => {
    const delta = deltaOf(lap(3, [0, 1.5, NaN, 4, NaN]), lap(2, [0, 1, 2, 4.5, 5]));
    expect(delta).toEqual([0, 0.5, null, -0.5, null]);
  });

  test("without the start of either there is none", () => {
    const unseen = lap(3, [0, 1], { start_seen: false });
    expect(deltaOf(unseen, lap(2, [0, 1]))).toEqual([null, null]);
    expect(deltaOf(lap(2, [0, 1]), unseen)).toEqual([null, null]);
    expect(noDeltaText(lap(2, [0]).row, unseen.row)).toBe("the start of lap 3 was not seen");
    expect(noDeltaText(lap(2, [0]).row, lap(1, [0]).row)).toBe("");
    expect(noDeltaText(lap(2, [0]).row, null)).toBe("no complete lap to compare with");
  });

  test("a column is in the unit that is shown, with its gaps", () => {
    const { row: its } = lap(1, []);
    const one = { row: its, points: points(1, [0, 1, 2], [10, NaN, 30]) };
    expect(columnOf(one, "speed", 2)).toEqual([20, null, 60]);
    expect(columnOf(one, "brake")).toEqual([null, null, null]);
  });

  test("the car is at the last point that it has reached", () => {
    const one = lap(2, [NaN, 0.125, NaN, 0.25, NaN]);
    expect([1999, 2125, 2249, 2250, 9e9].map((ms) => pointAt(one, ms))).toEqual([-1, 1, 1, 3, 3]);
  });

  test("what is missing of a lap is said", () => {
    expect(remarkOf(row(1))).toBe("");
    expect(remarkOf(row(1, { end_ms: null }))).toBe("not finished");
    expect(remarkOf(row(1, { start_seen: false, gap_s: 2.26 }))).toBe(
      "incomplete: start not seen, gap of 2.3 s",
    );
    expect(remarkOf(row(1, { finish_seen: false }))).toBe("incomplete: finish not seen");
  });
});

test("lap times and differences have their digits and signs", () => {
  expect(lapTimeText(37.4081, 3)).toBe("0:37.408");
  expect(lapTimeText(59.9996, 3)).toBe("1:00.000");
  expect(lapTimeText(125.5, 2)).toBe("2:05.50");
  expect(lapTimeText(NaN, 2)).toBe("\u2013");
  expect([0.0072, -0.0072, 0.0001, 0].map((s) => signedText(s, 3))).toEqual([
    "+0.007",
    "\u22120.007",
    "0.000",
    "0.000",
  ]);
});

test("a reason is said in words, one that is not known as the car names it", () => {
  const info = { labels: ["-", "line", "meteorite"] } as FieldInfo;
  expect([0, 1, 2, 9].map((value) => reasonText(value, info))).toEqual([
    "not known",
    "curve ahead: line and grip",
    "meteorite",
    "9",
  ]);
});
