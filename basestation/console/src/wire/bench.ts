/**
 * Messages of a bench server as the base forwards them: each is `{type, server, of}` with the
 * server's own line in `of`, as hil/cli/bench_server/PROTOCOL.md names its members. All of it is
 * simulation.
 */
// SPDX-License-Identifier: Apache-2.0

/** The link to the server, judged by the base. */
export interface BenchLink {
  up: boolean;
  problem: string | null;
  malformed: number;
  may_start: boolean;
  why_not: string | null;
}

export interface BenchScenario {
  id: string;
  name: string;
  description: string;
  duration_s: number | null;
  seed: number;
  lockstep: boolean;
  live: boolean;
  faults: string[];
  expect: string[];
  problem: string | null;
}

export type BenchState =
  "running" | "passed" | "failed" | "contact" | "unusable" | "crashed" | "stopped";
export type BenchMode = "lockstep" | "live";

export interface BenchRun {
  run: number;
  state: BenchState;
  scenario: string;
  name: string;
  seed: number;
  mode: BenchMode;
  by: string;
  stopped_by: string | null;
  why: string | null;
  /** By which the base serves the report; null: there is none. */
  page: string | null;
  report: string | null;
  junit: string | null;
  log: string | null;
}

export interface Planned {
  what: string;
  at_s: number;
  lasts_s?: number;
  track?: string;
}

export interface BenchPlan {
  run: number;
  duration_s: number;
  mode: BenchMode;
  faults: Planned[];
  flags: Planned[];
  operator: Planned[];
  expect: string[];
}

export interface BenchEvent {
  run: number;
  t_s: number;
  kind: string;
  text: string;
}

export interface TrackError {
  from_mps?: number;
  to_mps?: number | null;
  samples: number;
  mean_m: number | null;
  max_m: number | null;
  paper_best_m: number;
  paper_mean_m: number;
  beats: "best" | "mean" | "neither" | null;
}

export type Standing = "open" | "holds" | "failed";

export interface Reaction {
  to: string;
  at_s: number;
  speed_mps: number | null;
  reaction_ms: number | null;
  stop_m: number | null;
}

export interface BenchAt {
  run: number;
  t_s: number;
  speed_mps: number | null;
  mode: string;
  flag: string;
  laps: number;
  last_lap_s: number | null;
  best_lap_s: number | null;
  wall_gap_m: number | null;
  contact: boolean;
  overall: TrackError;
  cross_track: TrackError[];
  expect: Standing[];
  reactions: Reaction[];
}

export interface BenchVerdict {
  name: string;
  text?: string;
  pass: boolean;
  reason?: string;
}

export interface CarInContact {
  speed_mps: number | null;
  /** Offset on the track, left positive. */
  n_m: number | null;
}

/** Of the run's car with another one, judged by the bench. */
export interface CarContact {
  at_s: number;
  s_m: number;
  with: string;
  with_number: number;
  kind: string;
  rule: string;
  closing_mps: number | null;
  caused: boolean;
  caused_by_other: boolean;
  own: CarInContact;
  other: CarInContact;
}

export interface BenchResult {
  run: number;
  passed: boolean;
  timely: boolean;
  reactions: Reaction[];
  result?: { car_contact?: CarContact | null };
}

/** Of a sweep that has ended: how many of its cases had each verdict, and its page. */
export interface BenchSweep {
  name: string;
  scenario: string;
  cases: number;
  passed: number;
  failed: number;
  contact: number;
  refused: number;
  crashed: number;
  report: string;
  /** By which the base serves the report; null: there is none. */
  page: string | null;
}

export interface OfServer<T> {
  server: string;
  of: T;
}
