/**
 * What a check list says as a whole: the base's word where it is fresh, never more than that.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Checklist } from "../../wire/pit";

/** The base says it once a second. */
const kOldMs = 3000;

export type Verdict = "go" | "no-go" | "unknown";

/** Of the whole list; unknown where the base said nothing, or nothing lately. */
export function verdictOf(list: Checklist | null, nowMs: number, silent: boolean): Verdict {
  if (list === null || silent || !(nowMs - list.time_ms <= kOldMs)) return "unknown";
  return list.go && list.checks.length > 0 && list.checks.every((c) => c.go) ? "go" : "no-go";
}
