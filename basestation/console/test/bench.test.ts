/**
 * The bench on the console: what is kept of a server, the plan on its time axis, scenarios found by
 * words, seeds that the bench takes.
 */
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, test } from "vitest";
import { pageAddress } from "../src/pages/hil/bench_page";
import { findScenarios, seedOf } from "../src/pages/hil/chooser";
import { causeText } from "../src/pages/hil/contact";
import { hasPassed, otherVerdicts } from "../src/pages/hil/sweeps";
import { axisOf, happened, lanesOf, percent, progressOf } from "../src/pages/hil/lanes";
import { Bench, kKeptEvents } from "../src/store/bench";
import type {
  BenchEvent,
  BenchPlan,
  BenchRun,
  BenchScenario,
  BenchSweep,
  CarContact,
} from "../src/wire/bench";

const event = (run: number, t_s: number, kind = "flag"): BenchEvent => ({
  run,
  t_s,
  kind,
  text: "red",
});
const run = (number: number): BenchRun => ({
  run: number,
  state: "running",
  scenario: "a",
  name: "a",
  seed: 1,
  mode: "lockstep",
  by: "",
  stopped_by: null,
  why: null,
  page: null,
  report: null,
  junit: null,
  log: null,
});
const plan: BenchPlan = {
  run: 1,
  duration_s: 84,
  mode: "lockstep",
  faults: [
    { what: "gnss_rtk_lost", at_s: 20, lasts_s: 10 },
    { what: "grip 0.4", at_s: 50, lasts_s: 0 },
  ],
  flags: [
    { what: "red", at_s: 0.5 },
    { what: "green", at_s: 10 },
  ],
  operator: [{ what: "limit 30", at_s: 40 }],
  expect: [],
};

test("the cause of a contact is one car, both or neither", () => {
  const contact = { with: "slow", with_number: 2 } as CarContact;
  const words = [
    [true, false],
    [false, true],
    [true, true],
    [false, false],
  ].map(([caused, caused_by_other]) => causeText({ ...contact, caused, caused_by_other }));
  expect(words).toEqual(["THIS CAR", "slow (2)", "BOTH CARS", "NEITHER"]);
});

const sweep: BenchSweep = {
  name: "grip",
  scenario: "s.yaml",
  cases: 9,
  passed: 6,
  failed: 2,
  contact: 1,
  refused: 0,
  crashed: 0,
  report: "out/sweeps/grip/report.html",
  page: "sweeps/grip/report.html",
};

test("a sweep passed if every case did, and else says what the others came to", () => {
  expect(hasPassed(sweep)).toBe(false);
  expect(hasPassed({ ...sweep, passed: 9 })).toBe(true);
  expect(otherVerdicts(sweep)).toBe("2 failed, 1 contact");
  expect(otherVerdicts({ ...sweep, failed: 0, contact: 0 })).toBe("");
});

test("the address of a page is one of the base, whatever the bench names", () => {
  expect(pageAddress(2, "sweeps/grip/report.html")).toBe("/bench/2/sweeps/grip/report.html");
  expect(pageAddress(1, "a b/?x#y")).toBe("/bench/1/a%20b/%3Fx%23y");
  for (const name of ["//elsewhere/x", "javascript:x", "https://elsewhere/"])
    expect(new URL(pageAddress(1, name), "http://base").origin).toBe("http://base");
});

describe("what is kept of a server", () => {
  test("the newest list of sweeps", () => {
    const bench = new Bench();
    bench.texts.bench_sweeps({ server: "d", of: { sweeps: [sweep] } });
    expect(bench.sweeps.value).toEqual([sweep]);
    bench.texts.bench_sweeps({ server: "d", of: { sweeps: [] } });
    expect(bench.sweeps.value).toEqual([]);
  });

  test("events of the newest run only", () => {
    const bench = new Bench();
    bench.texts.bench_run({ server: "d", of: run(1) });
    bench.texts.bench_event({ server: "d", of: event(1, 1) });
    expect(bench.events.value).toHaveLength(1);
    bench.texts.bench_run({ server: "d", of: run(2) });
    expect(bench.events.value).toEqual([]);
    bench.texts.bench_event({ server: "d", of: event(1, 2) });
    expect(bench.events.value).toEqual([]);
    bench.texts.bench_event({ server: "d", of: event(2, 3) });
    expect(bench.events.value.map((e) => e.t_s)).toEqual([3]);
  });

  test("events that come before their run is told stay when it is", () => {
    const bench = new Bench();
    bench.texts.bench_event({ server: "d", of: event(3, 1) });
    bench.texts.bench_run({ server: "d", of: run(3) });
    expect(bench.events.value).toHaveLength(1);
    bench.texts.bench_run({ server: "d", of: { ...run(3), state: "passed" } });
    expect(bench.events.value).toHaveLength(1);
    expect(bench.run.value?.state).toBe("passed");
  });

  test("another server counts its runs from one again", () => {
    const bench = new Bench();
    bench.texts.bench_run({ server: "d", of: run(5) });
    bench.texts.bench_event({ server: "d", of: event(5, 1) });
    bench.texts.bench_run({ server: "e", of: run(1) });
    bench.texts.bench_event({ server: "e", of: event(1, 2) });
    expect(bench.events.value.map((e) => e.run)).toEqual([1]);
  });

  test("no more events than are kept", () => {
    const bench = new Bench();
    for (let i = 0; i < kKeptEvents + 20; ++i) {
      bench.texts.bench_event({ server: "d", of: event(1, i) });
    }
    expect(bench.events.value).toHaveLength(kKeptEvents);
    expect(bench.events.value.at(-1)?.t_s).toBe(kKeptEvents + 19);
  });
});

describe("the time axis", () => {
  test("a flag stands until the next, a fault without a length to the end", () => {
    expect(lanesOf(plan).map((l) => [l.kind, l.from, l.to])).toEqual([
      ["flag", 0.5, 10],
      ["flag", 10, 84],
      ["fault", 20, 30],
      ["fault", 50, 84],
      ["operator", 40, 40],
    ]);
  });

  test("nothing lies outside the axis", () => {
    const late = { ...plan, duration_s: 30 };
    for (const lane of lanesOf(late)) {
      expect(lane.from).toBeLessThanOrEqual(30);
      expect(lane.to).toBeLessThanOrEqual(30);
    }
    expect([percent(-1, 10), percent(5, 10), percent(11, 10), percent(1, 0)]).toEqual([
      0, 50, 100, 0,
    ]);
  });

  test("what is to come, under way and over", () => {
    const [, , fault] = lanesOf(plan);
    expect([0, 19.9, 20, 29, 30, NaN].map((s) => progressOf(fault, s))).toEqual([
      "to come",
      "to come",
      "under way",
      "under way",
      "over",
      "to come",
    ]);
  });

  test("marks at round seconds, never too many", () => {
    for (const length of [0.5, 3, 12, 84, 99, 700, 36_000]) {
      const marks = axisOf(length);
      expect(marks[0]).toBe(0);
      expect(marks.length).toBeLessThanOrEqual(9);
      expect(marks.at(-1)).toBeLessThanOrEqual(length);
    }
  });

  test("what is planned is not told twice", () => {
    const events = ["fault_begins", "mode", "lap", "fault_ends", "operator", "flag", "done"].map(
      (kind, i) => event(1, i, kind),
    );
    expect(happened(events).map((e) => e.kind)).toEqual(["mode", "lap", "flag", "done"]);
  });
});

describe("choosing", () => {
  const scenario = (id: string, description: string, faults: string[] = []): BenchScenario => ({
    id,
    name: id,
    description,
    duration_s: 10,
    seed: 1,
    lockstep: true,
    live: false,
    faults,
    expect: [],
    problem: null,
  });
  const all = [
    scenario("red_flag_stop", "Red at full speed."),
    scenario("faults/gnss", "Both receivers.", ["gnss_rtk_lost"]),
  ];

  test("every word must be somewhere", () => {
    expect(findScenarios(all, "")).toHaveLength(2);
    expect(findScenarios(all, "RED full")).toEqual([all[0]]);
    expect(findScenarios(all, "rtk")).toEqual([all[1]]);
    expect(findScenarios(all, "red rtk")).toEqual([]);
  });

  test("a seed is a whole number or none", () => {
    expect(seedOf("")).toBeNull();
    expect(seedOf(" 42 ")).toBe(42);
    expect(seedOf("1000000000")).toBe(1e9);
    for (const bad of ["-1", "1.5", "x", "1e3", "1000000001", "99999999999"]) {
      expect(seedOf(bad)).toBeUndefined();
    }
  });
});
