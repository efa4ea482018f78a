/**
 * The JSON texts between base and console, as PROTOCOL.md names them. Stamps `*_ms` are on the
 * clock of the snapshots.
 */
// SPDX-License-Identifier: Apache-2.0

export type Mode = "REAL" | "HIL" | "REPLAY" | "NONE";
export type Role = "viewer" | "operator";

export interface Hello {
  version: number;
  car: number;
  name: string;
  mode: Mode;
  role: Role;
  client: number;
  /** An override takes a second person's token; else a reason does. */
  second_person: boolean;
  alarm_config: string;
  time_ns: number;
  utc_ms: number;
}

/** Of a base that goes by bench time. */
export interface BenchTime {
  time_ms: number;
  /** For how long bench time stands by the wall clock; 0: it goes on. */
  stands_ms: number;
  /** In all, since the base began. */
  stood_ms: number;
}

export interface Limits {
  warning_low?: number;
  warning_high?: number;
  bad_low?: number;
  bad_high?: number;
  /** Values of an enumeration; not there: none. */
  warning_values?: number[];
  bad_values?: number[];
}

export interface FieldInfo {
  id: number;
  path: string;
  group: string;
  name: string;
  /** What people call it, in the terms of the trade. */
  title: string;
  unit: string;
  kind: string;
  min: number;
  max: number;
  resolution: number;
  labels?: string[] | null;
  period_ms: number;
  limits?: Limits | null;
}

export interface CommandInfo {
  name: string;
  unit: string;
  min: number;
  max: number;
  resolution: number;
  labels?: string[] | null;
  time_to_live_ms: number;
  needs_authority: boolean;
  /** False: no car carries it out, and the base refuses it. */
  offered: boolean;
}

/** What the passing competition counts with. */
export interface RaceRules {
  attempt_laps: number;
  pass_gap_m: number;
}

export interface Catalogue {
  fields: FieldInfo[];
  commands: CommandInfo[];
  race: RaceRules;
}

export interface Alarm {
  id: number;
  key: string;
  text: string;
  response: string;
  priority: "high" | "medium" | "low";
  state: "unack" | "acked" | "rtn_unack" | "latched";
  since_ms: number;
  value?: number | string | null;
  count: number;
  first_up: boolean;
  /** False: of a stop, which is never put out of sight. */
  can_be_shelved?: boolean;
  shelved_until_ms?: number | null;
  reason?: string | null;
  by?: string | null;
}

export interface Alarms {
  active: Alarm[];
  shelved: Alarm[];
  suppressed: Alarm[];
  kpi: { per_10_min: number; flood: boolean };
  revision: number | string;
}

export interface AlarmEvent {
  time_ms: number;
  key: string;
  from: string;
  to: string;
  by?: string | null;
  reason?: string | null;
}

export interface Authority {
  holder: number;
  holder_name: string;
  epoch: number;
  expires_ms: number;
  request: { by: number; name: string; until_ms: number } | null;
}

export interface Gate {
  name: string;
  ok: boolean;
  /** Null: no data. */
  value?: number | null;
  unit?: string;
  /** The name of the value, where it has one. */
  word?: string;
  age_ms?: number | null;
  can_be_overridden?: boolean;
  text: string;
}

export interface CommandStep {
  ticket: number;
  name: string;
  argument: number;
  by: string | number;
  step: string;
  gates?: Gate[];
  override?: { reason: string; token?: string } | null;
  times_ms?: Record<string, number>;
  text?: string;
}

export interface AuditLine {
  time_ms: number;
  who: string | number;
  what: string;
  result: string;
}

export interface CarEvent {
  time_ms: number;
  text: string;
  severity: string | number;
}

/** A moment that an operator marked in the recording. */
export interface Mark {
  time_ms: number;
  text: string;
  by?: string | null;
}

export interface LinkWindow {
  loss?: number | null;
  rtt_ms?: number | null;
  jitter_ms?: number | null;
  reorder?: number | null;
  duplicate?: number | null;
  kbit_s?: number | null;
  cap_kbit_s?: number | null;
}

export interface LinkPath {
  path: string | number;
  direction: string;
  [window: string]: unknown;
}

export interface Link {
  state: "good" | "degraded" | "lost";
  since_ms: number;
  paths?: LinkPath[];
  groups?: { group: string; kbit_s: number; age_ms: number; target_ms: number }[];
}

/** A message that a person reads out to race control. */
export interface Notice {
  id: number;
  kind: string;
  time_ms: number;
  text: string;
  evidence: string;
  state: "draft" | "reported" | "dismissed";
  by?: string | null;
}

export type RecoveryName = "release" | "acknowledge" | "reset" | "arm";

export interface RecoveryStep {
  step: RecoveryName;
  done: boolean;
  possible: boolean;
  /** What it waits for, or what became of the last try; empty: nothing to say. */
  why: string;
}

/** A stop from its beginning until the car is armed again. */
export interface StopState {
  stopped: boolean;
  level?: string;
  mode?: string;
  cause?: string;
  value?: number | null;
  unit?: string;
  /** Null: before this base heard the car. */
  since_ms?: number | null;
  /** Who latched it; empty: the car itself. */
  by?: string;
  latched?: boolean;
  /** Which latch a release is meant for; 0: none. */
  challenge?: number;
  steps?: RecoveryStep[];
}

export interface Fuel {
  level?: number | null;
  estimated?: boolean;
  laps: number | null;
  /** At the highest consumption; attempts follow from it. */
  least_laps?: number | null;
  attempts: number | null;
  per_lap: number | null;
  text: string;
}

/** What people said that no figure of the car says. */
export interface Expected {
  round_speed_mps: number | null;
  round_speed_by: string;
  fuel_loaded_l: number | null;
  fuel_by: string;
  fuel_ms: number | null;
}

export interface AlarmSetting {
  key: string;
  text: string;
  path: string;
  unit: string;
  side: "above" | "below";
  priority: "high" | "medium" | "low";
  limit: number;
  deadband: number;
  on_s: number;
  off_s: number;
  by: string | null;
}

export interface Settings {
  revision: number;
  kept: boolean;
  /** Not empty: the file of settings was unreadable, what is built in holds. */
  problem: string;
  up_kbit_s: number | null;
  up_least_kbit_s: number;
  up_most_kbit_s: number;
  alarms: AlarmSetting[];
}

/** A replay: where the base is in its recording. Each jump forgets what came before it. */
export interface Playback {
  begin_ms: number;
  end_ms: number;
  now_ms: number;
  speed: number;
  jumps: number;
}

export interface Track {
  name: string;
  length_m: number;
  centre: number[][];
  left: number[][];
  right: number[][];
  lines: { name: string; points: number[][] }[];
  pit: number[][];
  corners: { name: string; from_s: number; to_s: number }[];
  sectors: number[];
}
