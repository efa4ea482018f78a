/**
 * What pages compute without a browser: columns of charts, layouts out of foreign JSON, the ladder,
 * the order of alarms.
 */
// SPDX-License-Identifier: Apache-2.0
import { readFileSync, readdirSync } from "node:fs";
import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { meaningOf } from "../src/pages/alarms/settings";
import { isPending, rung } from "../src/pages/commands/steps";
import { columns, kGapMs, withEarlier } from "../src/pages/plots/series";
import { verdictOf } from "../src/pages/replay/verdict";
import { kStepM, lapColumns } from "../src/pages/plots/laps";
import { lapsBeside, readPlotLayout } from "../src/pages/plots/layout";
import { kDefaultLayout, moved, readPrimaryLayout } from "../src/pages/primary/layout";
import { Fields } from "../src/store/fields";
import { History } from "../src/store/history";
import { inOrder, loudest } from "../src/view/alarm_order";
import { decimalsOf, fixed, valueText } from "../src/view/format";
import type { Alarm, CommandStep } from "../src/wire/messages";
import { Quality } from "../src/wire/status";

const info = {
  id: 1,
  path: "a.b",
  group: "a",
  name: "b",
  title: "a of b",
  unit: "",
  kind: "real",
  min: 0,
  max: 9,
  resolution: 0.01,
  period_ms: 100,
};

function drawn(rows: readonly (readonly [ms: number, value: number, quality: Quality])[]): History {
  const fields = new Fields([info]);
  const history = new History(1, 4096);
  for (const [ms, value, quality] of rows) {
    fields.write(1, quality, 0, value, ms);
    history.append(fields, ms);
  }
  return history;
}

describe("columns of a chart", () => {
  test("stale is a gap", () => {
    const history = drawn([
      [0, 1, 0],
      [40, 2, Quality.stale],
      [80, 3, Quality.late],
    ]);
    expect(columns(history, [0], 0, 1000, 500).values[0]).toEqual([1, null, 3]);
  });

  test("time without rows is a gap", () => {
    const history = drawn([
      [0, 1, 0],
      [40 + kGapMs + 1000, 2, 0],
    ]);
    expect(columns(history, [0], 0, 9000, 500).values[0]).toEqual([1, null, 2]);
  });

  test("a field that the base does not have is nothing, not zero", () => {
    expect(columns(drawn([[0, 1, 0]]), [-1], 0, 9, 500).values[0]).toEqual([null]);
  });

  test("thinning keeps the extremes and the order of time", () => {
    fc.assert(
      fc.property(
        fc.array(fc.float({ min: -100, max: 100, noNaN: true }), {
          minLength: 300,
          maxLength: 900,
        }),
        (values) => {
          const history = drawn(values.map((value, i) => [40 * i, value, 0] as const));
          const {
            timeS,
            values: [thin],
          } = columns(history, [0], 0, 1e9, 100);
          expect(timeS.length).toBeLessThan(260);
          const known = thin.filter((v) => v !== null);
          expect(Math.max(...known)).toBeCloseTo(Math.max(...values), 4);
          expect(Math.min(...known)).toBeCloseTo(Math.min(...values), 4);
          for (let i = 1; i < timeS.length; ++i)
            expect(timeS[i]).toBeGreaterThanOrEqual(timeS[i - 1]);
        },
      ),
      { numRuns: 30 },
    );
  });

  const remembered = (timeS: number[], value: number[], quality: number[]) => ({
    timeS: new Float64Array(timeS),
    value: new Float32Array(value),
    quality: new Uint8Array(quality),
  });

  test("what the base remembers stands in front, its stale points as gaps", () => {
    const after = { timeS: [10, 11], values: [[5, 6]] };
    const earlier = remembered([7, 8, 9, 10.5], [1, 2, 3, 4], [0, 2, 0, 0]);
    expect(withEarlier(after, [earlier], 7.5)).toEqual({
      timeS: [8, 9, 10, 11],
      values: [[null, 3, 5, 6]],
    });
  });

  test("two fields of other rates share one axis, each holding its last point", () => {
    const after = { timeS: [10], values: [[5], [50]] };
    const fast = remembered([8, 8.5, 9], [1, 2, 3], [0, 0, 0]);
    const slow = remembered([8.2], [20], [0]);
    expect(withEarlier(after, [fast, slow], 0)).toEqual({
      timeS: [8, 8.2, 8.5, 9, 10],
      values: [
        [1, 1, 2, 3, 5],
        [null, 20, 20, 20, 50],
      ],
    });
    expect(withEarlier(after, [null, null], 0)).toEqual(after);
  });
});

describe("layouts out of foreign JSON", () => {
  test("what is no layout is refused, never thrown at", () => {
    fc.assert(
      fc.property(fc.jsonValue(), (json) => {
        readPrimaryLayout(json);
        readPlotLayout(json);
      }),
    );
    expect(readPlotLayout({ charts: [], window_s: 1e9 })).toBeNull();
    expect(readPrimaryLayout({ columns: [] })).toBeNull();
  });

  test("ours is read back as it is", () => {
    expect(readPrimaryLayout(JSON.parse(JSON.stringify(kDefaultLayout)))).toEqual(kDefaultLayout);
  });

  test("moving a panel loses none", () => {
    fc.assert(
      fc.property(
        fc.array(
          fc.tuple(
            fc.constantFrom("map", "speed", "tyres", "gnss", "computer"),
            fc.constantFrom("ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight"),
          ),
        ),
        (moves) => {
          let layout = kDefaultLayout;
          for (const [panel, key] of moves) layout = moved(layout, panel as never, key);
          const names = layout.columns.flatMap((column) => column.panels).sort();
          expect(names).toEqual(kDefaultLayout.columns.flatMap((c) => c.panels).sort());
        },
      ),
    );
  });
});

describe("ladder", () => {
  const step = (name: string, times: Record<string, number>): CommandStep => ({
    ticket: 1,
    name: "arm",
    argument: 1,
    by: "",
    step: name,
    times_ms: times,
  });
  test("knows how far a command got, also when it fell", () => {
    expect(rung(step("gated", { staged: 1, gated: 2 }))).toBe(1);
    expect(rung(step("refused", { staged: 1, gated: 2, sent: 3 }))).toBe(2);
    expect(rung(step("applied", {}))).toBe(4);
    expect(isPending(step("gated", {}))).toBe(true);
    expect(isPending(step("sent", {}))).toBe(false);
  });
});

describe("alarms", () => {
  const alarm = (
    id: number,
    priority: Alarm["priority"],
    state: Alarm["state"],
    since: number,
  ) => ({
    id,
    priority,
    state,
    since_ms: since,
    key: "",
    text: "",
    response: "",
    count: 1,
    first_up: false,
  });
  test("the loudest is the newest of the highest priority that nobody has seen", () => {
    const list = [
      alarm(1, "low", "unack", 9),
      alarm(2, "high", "acked", 10),
      alarm(3, "high", "unack", 4),
      alarm(4, "high", "rtn_unack", 5),
    ];
    expect(loudest(list)?.id).toBe(4);
    expect(inOrder(list).map((a) => a.id)).toEqual([4, 3, 1, 2]);
    expect(loudest([alarm(2, "high", "acked", 10)])).toBeUndefined();
  });
});

describe("numbers", () => {
  test("have the decimals of their resolution", () => {
    expect([1, 0.5, 0.1, 0.05, 0.001, 2, 0].map(decimalsOf)).toEqual([0, 1, 1, 2, 3, 0, 1]);
    expect(fixed(-0.04, 1)).toBe("0.0");
    expect(fixed(-1.25, 2)).toBe("\u22121.25");
  });
  test("that are names are named, sets by their members", () => {
    expect(valueText({ ...info, labels: ["no", "yes"] }, 1)).toBe("yes");
    expect(valueText({ ...info, labels: ["no", "yes"] }, 7)).toBe("7");
    expect(valueText({ ...info, unit: "bits", labels: ["a", "b", "c"] }, 5)).toBe("a, c");
    expect(valueText(info, NaN)).toBe("\u2013");
  });
});

describe("the value of an enumeration", () => {
  test("is bad before it is a warning, and good in no set", () => {
    const limits = { warning_values: [1, 3], bad_values: [3, 4] };
    expect([0, 1, 3, 4].map((v) => meaningOf(limits, v))).toEqual([
      "good",
      "warning",
      "bad",
      "bad",
    ]);
    expect(meaningOf({}, 1)).toBe("good");
  });
});

describe("the check list", () => {
  const row = (go: boolean) => ({ name: "link", go, known: true, age_ms: 20, text: "good" });
  const list = (go: boolean, checks: boolean[]) => ({ time_ms: 1000, go, checks: checks.map(row) });
  test("is a go only where the base says so of everything, and lately", () => {
    expect(verdictOf(list(true, [true, true]), 2000, false)).toBe("go");
    expect(verdictOf(list(false, [true, true]), 2000, false)).toBe("no-go");
    expect(verdictOf(list(true, [true, false]), 2000, false)).toBe("no-go");
    expect(verdictOf(list(true, []), 2000, false)).toBe("no-go");
    expect(verdictOf(list(true, [true]), 4001, false)).toBe("unknown");
    expect(verdictOf(list(true, [true]), 2000, true)).toBe("unknown");
    expect(verdictOf(list(true, [true]), NaN, false)).toBe("unknown");
    expect(verdictOf(null, 2000, false)).toBe("unknown");
  });
});

describe("laps over each other", () => {
  const kLengthM = 1000;
  const path = (id: number, name: string) => ({ ...info, id, path: `t.${name}` });
  /** A car at 50 m/s, a row every 40 ms; `value` of the lap and the station. */
  function driven(
    seconds: number,
    value: (lap: number, station: number) => number,
    quality: (ms: number) => Quality = () => Quality.fresh,
  ): History {
    const fields = new Fields([path(1, "station"), path(2, "lap"), path(3, "value")]);
    const history = new History(3, 4096);
    for (let ms = 0; ms <= 1000 * seconds; ms += 40) {
      const way = 0.05 * ms;
      const [lap, station] = [Math.floor(way / kLengthM), way % kLengthM];
      [station, lap + 7, value(lap, station)].forEach((v, i) =>
        fields.write(i + 1, quality(ms), 0, v, ms),
      );
      history.append(fields, ms);
    }
    return history;
  }
  const slots = { station: 0, lap: 1 };
  const over = (history: History, most: number, endMs = 1e9) =>
    lapColumns(history, slots, [2], kLengthM, endMs, most);

  test("a place of the track is the same row in every lap", () => {
    const { stationM, laps, values } = over(
      driven(50, (lap, station) => 100 * lap + station / 10),
      3,
    );
    expect(laps.map((lap) => lap.number)).toEqual([9, 8, 7]);
    expect(stationM.length).toBe(kLengthM / kStepM + 1);
    const [now, before, first] = values[0];
    for (let i = 1; i < 99; ++i) {
      expect(now[i]).toBeCloseTo(200 + stationM[i] / 10, 3);
      expect(before[i]! - first[i]!).toBeCloseTo(100, 3);
    }
    // The lap that is being driven ends where the car is, at 500 m.
    expect(now[102]).toBeNull();
    expect(before[150]).toBeCloseTo(175, 3);
  });

  test("only so many laps, up to the moment shown", () => {
    const history = driven(90, (lap) => lap);
    expect(over(history, 2).laps.map((lap) => lap.number)).toEqual([11, 10]);
    expect(over(history, 2, 30_000).laps.map((lap) => lap.number)).toEqual([8, 7]);
  });

  test("what was stale or not heard is a gap, and no line across it", () => {
    const silent = (ms: number) => (ms > 4000 && ms < 8000 ? Quality.stale : Quality.fresh);
    const [column] = over(
      driven(15, () => 1, silent),
      1,
    ).values[0];
    expect(column[30]).toBe(1);
    expect(column.slice(42, 79).every((v) => v === null)).toBe(true);
    expect(column[100]).toBe(1);
  });

  test("a car without a station has no laps, one without a count has", () => {
    const history = driven(50, (lap) => lap);
    const none = lapColumns(history, { station: -1, lap: 1 }, [2], kLengthM, 1e9, 3);
    expect(none.laps).toEqual([]);
    const uncounted = lapColumns(history, { station: 0, lap: -1 }, [2], kLengthM, 1e9, 3);
    expect(uncounted.laps.map((lap) => lap.number)).toEqual([NaN, NaN, NaN]);
    expect(lapColumns(history, slots, [-1], kLengthM, 1e9, 1).values[0][0][5]).toBeNull();
  });

  test("as many laps beside each other as colours can tell", () => {
    expect([0, 1, 2, 3, 4, 6].map(lapsBeside)).toEqual([3, 3, 3, 2, 1, 1]);
  });
});

test("the style sheet of a page that comes later speaks of that page alone", () => {
  const pages = new URL("../src/pages/", import.meta.url);
  const sheets = readdirSync(pages, { recursive: true, encoding: "utf8" }).filter((name) =>
    name.endsWith(".css"),
  );
  expect(sheets.length).toBeGreaterThan(0);
  for (const sheet of sheets) {
    const text = readFileSync(new URL(sheet, pages), "utf8").replace(/\/\*[^]*?\*\//g, "");
    const selectors = [...text.matchAll(/([^{}]+)\{/g)]
      .flatMap(([, list]) => list.split(/,(?![^(]*\))/))
      .map((selector) => selector.trim())
      .filter((selector) => !selector.startsWith("@"));
    const root = `.${sheet.split("/")[0]}-page`;
    expect(selectors.filter((selector) => !selector.startsWith(root))).toEqual([]);
  }
});
