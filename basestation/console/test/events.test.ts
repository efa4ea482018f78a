/**
 * The event log as lines, its file, and the display rule of units, without a browser.
 */
// SPDX-License-Identifier: Apache-2.0
import { beforeEach, describe, expect, test } from "vitest";
import { eventLines, filterLines, kSources } from "../src/pages/events/lines";
import { axisUnits, inShownUnits } from "../src/pages/plots/lines";
import type { Line } from "../src/pages/plots/lines";
import { CarSession } from "../src/store/car_session";
import { findFields } from "../src/view/find_fields";
import { clockText, runsText } from "../src/view/format";
import { tsvText } from "../src/view/save_lines";
import { shownDigits, shownText, shownUnit } from "../src/view/shown_unit";
import { kSpeedUnits, nextSpeedUnit, speedUnit } from "../src/view/speed_unit";
import { inDisplayUnits } from "../src/view/display_units";
import type { FieldInfo } from "../src/wire/messages";

const lists = {
  car: [
    { time_ms: 1000, text: "lap 3: 45.210 s", severity: "info" },
    { time_ms: 3000, text: "limit 62.1 m/s", severity: "warning" },
  ],
  alarm: [
    { time_ms: 2000, key: "oil_pressure", from: "normal", to: "unack", by: null, reason: null },
    { time_ms: 4000, key: "no_such", from: "unack", to: "acked", by: "Ada", reason: "seen" },
  ],
  audit: [{ time_ms: 3000, who: "console 16", what: "role attacker", result: "sent" }],
  marks: [{ time_ms: 500, text: "bump", by: "Ada" }],
};
const lines = eventLines(lists, (key) => (key === "oil_pressure" ? "Oil pressure low" : key));

describe("lines of the event log", () => {
  test("are one list, newest first", () => {
    expect(lines.map((line) => [line.source, line.kind, line.what])).toEqual([
      ["alarm", "acknowledged", "no_such by Ada: seen"],
      ["operator", "sent", "console 16: role attacker"],
      ["car", "warning", "limit 62.1 m/s"],
      ["alarm", "new", "Oil pressure low"],
      ["car", "info", "lap 3: 45.210 s"],
      ["operator", "mark", "Ada: bump"],
    ]);
  });

  test("are made of the messages themselves", () => {
    expect(lines[0].of).toBe(lists.alarm[1]);
    expect(new Set(lines.map((line) => line.of)).size).toBe(lines.length);
  });

  test("are filtered by source and by every word of what is shown", () => {
    const all = new Set(kSources);
    const what = (query: string, sources = all) =>
      filterLines(lines, sources, query, inDisplayUnits).map((line) => line.what);
    expect(what("")).toHaveLength(6);
    expect(what("", new Set())).toEqual([]);
    expect(what("", new Set(["car"] as const))).toEqual(["limit 62.1 m/s", "lap 3: 45.210 s"]);
    expect(what("OIL low")).toEqual(["Oil pressure low"]);
    expect(what("oil high")).toEqual([]);
    expect(what("alarm ack")).toEqual(["no_such by Ada: seen"]);
    speedUnit.value = kSpeedUnits[0];
    expect(what("138.9 mph")).toEqual(["limit 62.1 m/s"]);
  });

  test("a file has a line each, no tab or line end inside a cell", () => {
    expect(tsvText(["utc", "what"], [["t", "a\tb\r\nc"]])).toBe("utc\twhat\nt\ta b  c\n");
    expect(tsvText(["n"], [])).toBe("n\n");
  });

  test("have a time of day with tenths", () => {
    const at = Date.UTC(2026, 0, 9, 9, 4, 2, 370);
    expect(clockText(at)).toBe("09:04:02");
    expect(clockText(at, 1)).toBe("09:04:02.3");
    expect(clockText(NaN, 1)).toBe("\u2013");
  });
});

const field = (unit: string, resolution: number, more: Partial<FieldInfo> = {}): FieldInfo => ({
  id: 1,
  path: "a.b",
  group: "a",
  name: "b",
  title: "b of a",
  unit,
  kind: "real",
  min: 0,
  max: 1,
  resolution,
  period_ms: 100,
  ...more,
});

describe("the unit that is shown", () => {
  beforeEach(() => void (speedUnit.value = kSpeedUnits[0]));

  test("of a speed is the operator's, and follows the choice", () => {
    const speed = field("m/s", 0.02);
    expect(shownText(speed, 62.5)).toBe("139.81 mph");
    nextSpeedUnit();
    expect(shownText(speed, 62.5)).toBe("225.00 km/h");
    nextSpeedUnit();
    expect(shownText(speed, 62.5)).toBe("62.50 m/s");
  });

  test("of an acceleration or a rate of turn stays", () => {
    expect(shownText(field("m/s^2", 0.1), 21.24)).toBe("21.2 m/s\u00b2");
    expect(shownUnit("rad/s")).toEqual({ name: "rad/s", factor: 1 });
  });

  test("of an angle is the degree, with the decimals that the resolution carries", () => {
    expect(shownText(field("rad", 0.0004), -0.014)).toBe("\u22120.80\u00b0");
    expect(shownDigits(field("rad", 0.002), Math.PI)).toBe("180.0");
  });

  test("a label and a share stay what they are", () => {
    expect(shownText(field("", 1, { labels: ["no", "yes"] }), 1)).toBe("yes");
    expect(shownText(field("", 0.01), 0.5)).toBe("0.50");
    expect(shownText(field("m/s", 1), NaN)).toBe("\u2013 mph");
  });
});

describe("lines of a chart", () => {
  const car = new CarSession(7);
  const info = [
    field("m/s", 0.1, { id: 0, path: "ego.vx", title: "speed" }),
    field("rad", 0.1, { id: 1, path: "ego.yaw", title: "yaw angle" }),
    field("", 0.1, { id: 2, path: "ego.n", title: "n" }),
  ];
  car.takeCatalogue({ fields: info, commands: [], race: { attempt_laps: 2, pass_gap_m: 30 } });
  const line = (path: string): Line => ({ path, back: 0, car, other: false, field: 0 });

  test("of another car that is not named yet are drawn as they are", () => {
    const drawn = inShownUnits([[1], [10], [20]], [line("ego.vx")]);
    expect(drawn[2]).toEqual([20]);
  });
  test("are drawn in the units shown, gaps stay gaps", () => {
    speedUnit.value = kSpeedUnits[1];
    const drawn = inShownUnits(
      [
        [1, 2, 3],
        [10, null, undefined],
        [0, Math.PI, null],
        [5, 6, 7],
        [1, null, 2],
      ],
      ["ego.vx", "ego.yaw", "ego.n", "gone"].map(line),
    );
    expect(drawn).toEqual([
      [1, 2, 3],
      [36, null, undefined],
      [0, 180, null],
      [5, 6, 7],
      [1, null, 2],
    ]);
    expect(axisUnits(["ego.vx", "ego.yaw", "ego.n", "ego.vx"].map(line))).toBe("km/h, \u00b0");
  });

  test("are found by title and by path", () => {
    const found = (query: string) => findFields(info, query).map((it) => it.path);
    expect(found("yaw angle")).toEqual(["ego.yaw"]);
    expect(found("SPEED")).toEqual(["ego.vx"]);
    expect(found("ego.vx")).toEqual(["ego.vx"]);
    expect(found("n")[0]).toBe("ego.n");
    expect(found("speed yaw")).toEqual([]);
  });
});

test("numbers of keys are told as runs", () => {
  expect(runsText([1, 2, 3, 4, 5, 6, 7, 8, 9, 0])).toBe("1 \u2026 9, 0");
  expect(runsText([1, 2, 5])).toBe("1, 2, 5");
});
