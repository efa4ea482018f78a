/**
 * What the base says of a car before it is let out, and which recordings it has, as PROTOCOL.md
 * names them.
 */
// SPDX-License-Identifier: Apache-2.0

export interface Check {
  name: string;
  go: boolean;
  /** Heard, and not stale. */
  known: boolean;
  age_ms: number;
  text: string;
}

export interface Checklist {
  time_ms: number;
  go: boolean;
  checks: Check[];
}

export interface Recording {
  name: string;
  folder: string;
  car: string;
  car_name: string;
  segments: number;
  bytes: number;
  first_utc_ms: number | null;
  last_utc_ms: number | null;
  /** Somebody writes it now. */
  running: boolean;
  /** Why it cannot be played; empty where it can. */
  problem: string;
  /** What plays it, for a terminal of the base's machine. */
  command: string;
}

export interface Recordings {
  root: string;
  left_out: number;
  problem: string;
  recordings: Recording[];
}
