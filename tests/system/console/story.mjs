/**
 * A race situation for the double with everything in it that a page can show: alarms of each kind,
 * a command refused by its gates, an audit log, link figures, a draft to race control.
 */
// SPDX-License-Identifier: Apache-2.0
import { kBad, kLate, kStale, kWarning } from "./wire.mjs";

const alarm = (id, priority, state, text, response, more = {}) => ({
  id,
  key: `alarm_${id}`,
  text,
  response,
  priority,
  state,
  since_ms: 0,
  value: null,
  count: 1,
  first_up: false,
  ...more,
});

export function alarms(now) {
  return {
    type: "alarms",
    revision: 4,
    kpi: { per_10_min: 3, flood: false },
    active: [
      alarm(1, "high", "unack", "Rear wheels 9.4 % faster than GNSS", "Lift.", {
        since_ms: now - 4_000,
        first_up: true,
      }),
      alarm(
        2,
        "medium",
        "unack",
        "Tyres cold for the commanded speed: 74 of 79 \u00b0C",
        "Warm-up laps.",
        { since_ms: now - 31_000, count: 3 },
      ),
      alarm(3, "medium", "acked", "RTK corrections 6.2 s old", "Slow; check the modem.", {
        since_ms: now - 95_000,
      }),
      alarm(4, "low", "rtn_unack", "Recorder disk below 30 minutes", "Change the disk.", {
        since_ms: now - 240_000,
      }),
    ],
    shelved: [
      alarm(5, "low", "acked", "Camera rate 71 % of nominal", "Terminate?", {
        reason: "camera is off today",
        by: "console 16",
        shelved_until_ms: now + 200_000,
      }),
    ],
    suppressed: [
      alarm(6, "medium", "acked", "Oil pressure low", "Stop the engine.", {
        reason: "engine off",
      }),
    ],
  };
}

const gate = (name, ok, value, unit, age, text, more = {}) => ({
  name,
  ok,
  value,
  unit,
  word: "",
  age_ms: age,
  can_be_overridden: true,
  text,
  ...more,
});

const gates = (ok) => [
  gate("flag", true, 4, "", 40, "track GREEN, vehicle ATTACKER", { word: "GREEN" }),
  gate("link", true, 1, "", 20, "link good", { word: "good", can_be_overridden: false }),
  gate("tyres", ok, ok ? 81 : 29, "degC", 300, "29.0 degC, 79.0 degC needed for 71.1 m/s"),
  gate("step", ok, ok ? 4 : 9, "m/s", 60, "+9.0 m/s, at most +5.0 m/s"),
  gate("corner", ok, ok ? 11.2 : 1.4, "s", 60, "a corner in 1.4 s, more than 3.0 s needed"),
  gate("fuel", true, 5, "attempts", 800, "14.9 laps, attempts: 5.0"),
];

/** As many gates as a speed has, none of which knows anything. */
export const nothingKnown = [
  ["stop", ""],
  ["flag", ""],
  ["tyres", "degC"],
  ["step", "m/s"],
  ["corner", "s"],
  ["fuel", "attempts"],
  ["alarms", "high alarms"],
  ["race control", ""],
  ["standing", "m/s"],
].map(([name, unit]) => gate(name, false, null, unit, null, "not received yet: no data"));

export function refusedCommand(now) {
  return {
    type: "command",
    ticket: 41,
    name: "speed limit",
    argument: 71.1,
    by: "console 16",
    step: "gated",
    gates: gates(false),
    override: null,
    times_ms: { staged: now - 5000, gated: now - 4990 },
    text: "",
  };
}

export function appliedCommand(now) {
  return {
    type: "command",
    ticket: 40,
    name: "speed limit",
    argument: 62.1,
    by: "console 16",
    step: "applied",
    gates: gates(true),
    override: null,
    times_ms: {
      staged: now - 64_000,
      gated: now - 63_990,
      sent: now - 61_000,
      received: now - 60_940,
      applied: now - 60_900,
    },
    text: "operator limit 62.1 m/s",
  };
}

export function refusedByCar(now) {
  return {
    type: "command",
    ticket: 39,
    name: "arm",
    argument: 1,
    by: "console 17",
    step: "refused",
    gates: gates(true),
    override: null,
    times_ms: {
      staged: now - 164_000,
      gated: now - 163_990,
      sent: now - 161_000,
    },
    text: "the car moves",
  };
}

/** A stop of the car that an operator has latched, at a standstill. */
export const stopped = (now, more = {}) => ({
  type: "stop_state",
  stopped: true,
  level: "controlled stop",
  mode: "halted",
  cause: "dead reckoning too long",
  value: 1.6,
  unit: "s",
  since_ms: now - 41_000,
  by: "Ada",
  latched: true,
  challenge: 4711,
  steps: [
    { step: "release", done: false, possible: true, why: "" },
    { step: "acknowledge", done: false, possible: true, why: "" },
    { step: "reset", done: false, possible: false, why: "release the stop first" },
    { step: "arm", done: false, possible: false, why: "reset the car first" },
  ],
  ...more,
});

const windows = (loss, rtt) =>
  [1, 5, 30].map((seconds) => ({
    seconds,
    loss: loss * (1 + 1 / seconds),
    rtt_ms: rtt,
    jitter_ms: 3.1,
    reorder: 0.001,
    duplicate: 0,
    kbit_s: 26.2,
    cap_kbit_s: 28,
  }));

export function link(now) {
  const groups = [
    "mode",
    "flags",
    "uplink",
    "ego",
    "track",
    "command",
    "feedback",
    "wheels",
    "dynamics",
    "opponent_1",
    "planner",
    "tyres",
    "engine",
    "fuel",
    "localization",
    "streams",
  ];
  return {
    type: "link",
    state: "good",
    since_ms: now - 312_000,
    paths: [
      { path: 0, direction: "down", windows: windows(0.012, 31) },
      { path: 0, direction: "up", windows: windows(0.004, 31) },
      { path: 1, direction: "down", windows: windows(0.051, 64) },
    ],
    groups: groups.map((group, i) => ({
      group,
      kbit_s: 6.2 / (1 + i / 2),
      age_ms: 60 + 40 * i,
      target_ms: i < 3 ? 100 : 150,
    })),
  };
}

const error = (from_mps, to_mps, samples, mean_m, best, mean) => ({
  from_mps,
  to_mps,
  samples,
  mean_m: samples ? mean_m : null,
  max_m: samples ? 2.4 * mean_m : null,
  paper_best_m: best,
  paper_mean_m: mean,
  beats: !samples ? null : mean_m <= best ? "best" : mean_m <= mean ? "mean" : "neither",
});

/** A bench server in the middle of a run with a fault under way and a gate that has failed. */
export function bench() {
  const scenario = (id, description, more = {}) => ({
    type: "scenario",
    id,
    name: id,
    description,
    duration_s: 84,
    seed: 19,
    lockstep: true,
    live: true,
    faults: [],
    expect: ["always wall_gap_m > 0.5"],
    problem: null,
    ...more,
  });
  const sweep = (name, counts) => ({
    name,
    scenario: "hil/scenarios/red_flag_stop.yaml",
    cases: 200,
    failed: 0,
    contact: 0,
    refused: 0,
    crashed: 0,
    report: `out/sweeps/${name}/report.html`,
    page: `sweeps/${name}/report.html`,
    ...counts,
  });
  const expect = [
    "within 28 s: speed_mps > 55, from 10 s",
    "always wall_gap_m > 0.5",
    "never side_slip_deg > 5",
    "within 26 s: speed_mps < 0.3, from 50 s",
  ];
  const of = (type, line) => ({ type: `bench_${type}`, server: "server 1", of: line });
  return [
    { type: "bench", up: true, problem: null, malformed: 0, may_start: true, why_not: null },
    of("list", [
      scenario("faults/gnss_rtk_lost", "Corrections end for ten seconds.", {
        faults: ["gnss_rtk_lost"],
      }),
      scenario("ims_flying_lap", "A flying lap of Indianapolis."),
      scenario("red_flag_stop", "Red at full speed in a corner: a planned stop."),
      scenario("spoilt", "", { problem: "spoilt.yaml:4:7: error: not a number", duration_s: null }),
      scenario("wheel_speeds_lost", "Wheel speeds end at speed.", { lockstep: false }),
    ]),
    of("sweeps", {
      type: "sweeps",
      sweeps: [
        sweep("grip_and_wind", { passed: 197, failed: 2, contact: 1 }),
        sweep("launch_delays", { passed: 200 }),
      ],
    }),
    of("run", {
      type: "run",
      run: 4,
      state: "running",
      scenario: "red_flag_stop",
      name: "red_flag_stop",
      seed: 77,
      mode: "live",
      by: "console 16",
      stopped_by: null,
      why: null,
      page: null,
      report: "out/bench/4/report.html",
      junit: "out/bench/4/junit.xml",
      log: "out/bench/4/events.mcap",
    }),
    of("plan", {
      type: "plan",
      run: 4,
      mode: "live",
      duration_s: 84,
      faults: [
        { what: "gnss_rtk_lost unit 1", at_s: 20, lasts_s: 12 },
        { what: "radio_loss 0.4", at_s: 48, lasts_s: 20 },
        { what: "tyres_cold 29", at_s: 70, lasts_s: 0 },
      ],
      flags: [
        { what: "red", at_s: 0.5, track: "red" },
        { what: "green 147 mph", at_s: 10, track: "green" },
        { what: "red", at_s: 50, track: "red" },
      ],
      operator: [{ what: "limit 60", at_s: 40 }],
      expect,
    }),
    ...[
      [0.5, "flag", "red"],
      [10, "flag", "green 147 mph"],
      [10.02, "mode", "driving"],
      [20, "fault_begins", "gnss_rtk_lost unit 1"],
      [32, "fault_ends", "gnss_rtk_lost unit 1"],
      [46.3, "lap", "1"],
      [48, "fault_begins", "radio_loss 0.4"],
      [50, "flag", "red"],
    ].map(([t_s, kind, text]) => of("event", { type: "event", run: 4, t_s, kind, text })),
    of("at", {
      type: "at",
      run: 4,
      t_s: 53.5,
      speed_mps: 41.3,
      mode: "driving",
      flag: "red",
      laps: 1,
      last_lap_s: 42.18,
      best_lap_s: 42.18,
      wall_gap_m: 1.31,
      contact: false,
      overall: error(undefined, undefined, 4_210, 0.281, 0.244, 0.372),
      cross_track: [
        error(60, null, 1_830, 0.412, 0.54, 0.689),
        error(55, 60, 420, 0.611, 0.457, 0.832),
        error(50, 55, 300, 0.702, 0.479, 0.653),
        error(45, 50, 0, 0, 0.412, 0.519),
      ],
      expect: ["holds", "holds", "failed", "open"],
      reactions: [{ to: "red", at_s: 50, speed_mps: 65.1, reaction_ms: 120, stop_m: null }],
    }),
  ];
}

/** The run of bench() once it has ended in a contact with another car. */
export function contactRun() {
  const of = (type, line) => ({ type: `bench_${type}`, server: "server 1", of: line });
  const text =
    "contact with slow, from behind, at 53.62 s, s 1204 m, closing at 6.9 m/s; caused by this car";
  const { of: run } = bench().find(({ type }) => type === "bench_run");
  return [
    of("event", { type: "event", run: 4, t_s: 53.62, kind: "contact", text }),
    of("result", {
      type: "result",
      run: 4,
      passed: false,
      timely: true,
      reactions: [],
      result: {
        car_contact: {
          at_s: 53.62,
          s_m: 1204.3,
          with: "slow",
          with_number: 2,
          kind: "from behind",
          rule: "rule 2: the car behind must pass safely",
          closing_mps: 6.9,
          caused: true,
          caused_by_other: false,
          own: { speed_mps: 41.2, n_m: -0.4 },
          other: { speed_mps: 34.3, n_m: -0.9 },
        },
      },
    }),
    of("run", { ...run, state: "contact", page: "runs/4/report.html" }),
  ];
}

/** What a console hears on connecting, after hello and catalogue. */
export function greetings(double) {
  const now = double.nowMs();
  const audit = [
    "stop released",
    "speed limit 62.1 m/s sent",
    "role attacker sent",
    "authority taken",
    "alarm RTK corrections acknowledged",
  ];
  return [
    ...bench(),
    {
      type: "authority",
      holder: 16,
      holder_name: "console 16",
      epoch: 3,
      expires_ms: now + 2500,
      request: { by: 17, name: "console 17", until_ms: now + 4000 },
    },
    alarms(now),
    link(now),
    refusedByCar(now),
    appliedCommand(now),
    refusedCommand(now),
    {
      type: "fuel",
      laps: 14.9,
      least_laps: 11.6,
      attempts: 5,
      per_lap: 2.1,
      text: "14.9 laps: five attempts and the way home",
    },
    {
      type: "notice",
      id: 1,
      kind: "degraded",
      text: "Car 7: radio degraded since 19:02:40 UTC. The car drives on under its own rules.",
      evidence: "loss 14 % over 5 s, round trip 212 ms, car state driving",
      time_ms: now - 22_000,
      state: "draft",
      by: null,
    },
    ...audit.map((what, i) => ({
      type: "audit",
      time_ms: now - 200_000 + 30_000 * i,
      who: "console 16",
      what,
      result: "ok",
    })),
    ...[
      ["mode: standby -> driving", "info"],
      ["lap 3: 38.420 s", "info"],
      ["fault: GNSS corrections lost", "warning"],
    ].map(([text, severity], i) => ({
      type: "event",
      time_ms: now - 150_000 + 45_000 * i,
      text,
      severity,
    })),
    { type: "mark", time_ms: now - 12_300, text: "bump in T3", by: "console 16" },
    ...["unack", "acked"].map((to, i) => ({
      type: "alarm_event",
      time_ms: now - 95_000 + 9_000 * i,
      key: "rtk_correction_age",
      from: i ? "unack" : "normal",
      to,
      by: i ? "console 16" : "",
      reason: "",
    })),
  ];
}

/** Fields out of order: one of each kind that a page must be able to draw. */
export function troubles(double) {
  double.set("derived.slip", 0.094, kBad);
  double.set("tyres.temperature_front_left", 74, kWarning);
  double.set("derived.tyre_min", 74, kWarning);
  double.set("gnss1.differential_age", 6.2, kWarning);
  double.set("streams.gnss1_solution", 3, kWarning);
  double.set("streams.radio", 4, kBad);
  double.set("sensors.lidar_rate", 12.1, kBad);
  double.set("sensors.lidar_gap", 540, kBad);
  double.set("fuel.level", 31.2, 0, kLate);
  double.set("electric.battery", 13.8, 0, kStale);
  double.set("dynamics.lateral_error", -1.38, kWarning);
  double.set("flags.track", 5);
  double.set("flags.vehicle", 10);
  double.set("flags.track_acted_on", 4);
  double.set("flags.vehicle_acted_on", 10);
  double.set("derived.flag_conflict", 1, kBad);
  double.set("derived.round_speed_conflict", 0);
  double.set("derived.race_control_speed", 55.9);
  double.set("derived.round_speed_expected", 51.4);
  double.set("derived.fuel_state", 1);
  double.set("derived.role", 2);
  double.set("derived.role_conflict", 0);
  double.set("derived.attempt", 3);
  double.set("derived.attempt_state", 1);
  double.set("derived.attempt_laps", 1.37);
  double.set("derived.attempt_laps_left", 0.63);
  double.set("derived.gap_ahead", 18.4, 0, kStale);
  double.set("derived.gap_behind", 44.1);
  double.set("derived.gap_closing", 2.2);
}

const check = (name, go, text, ageMs = 40, known = true) => ({
  name,
  go,
  known,
  age_ms: ageMs,
  text,
});

/** The list before a run: two items hold the car back, one of them because nothing is known. */
export const checklist = (now) => ({
  type: "checklist",
  time_ms: now,
  go: false,
  checks: [
    check("link", true, "good, 1.2 % lost", 20),
    check("software", true, "car and base agree on the packets", 180),
    check("clocks", true, "base 0.4 ms from UTC at the most"),
    check("disk", true, "recording on, room for 412.0 min"),
    check("limits and alarms", true, "version 3-3f2a, of the file", 0),
    check("authority", true, "held by console 16", 0),
    check("joystick", true, "connected, released", 0),
    check("RTK corrections", false, "somebody else uses the login, corrections 6.2 s old", 90),
    check("tyres", false, "too old: 8.4 s; softest 149.0 kPa, coldest 74.0 \u00b0C", 8400, false),
    check("fuel", true, "14.9 laps, 5.0 attempts", 220),
    check("stop", true, "none", 60),
    check("alarms", true, "0 high", 0),
  ],
});

const recording = (name, segments, hour, more = {}) => ({
  name,
  folder: `/srv/pitwall/recordings/${name}`,
  car: "7",
  car_name: "Caracara",
  segments,
  bytes: 3_900_000 * segments,
  first_utc_ms: Date.UTC(2026, 0, 9, hour, 2, 10),
  last_utc_ms: Date.UTC(2026, 0, 9, hour, 1 + segments, 10),
  running: false,
  problem: "",
  command: `pitwall-base --replay /srv/pitwall/recordings/${name} --web 0 --track lvms`,
  ...more,
});

export const kRecordings = {
  root: "/srv/pitwall/recordings",
  left_out: 0,
  problem: "",
  recordings: [
    recording("passing_round_3", 12, 19, { running: true }),
    recording("passing_round_2", 34, 18),
    recording("warm_up", 21, 16),
    recording("copied", 0, 15, {
      problem: "no segment in it",
      first_utc_ms: null,
      last_utc_ms: null,
    }),
  ],
};
