/**
 * The plan of a bench run on its time axis: one lane for each thing that is planned, and what of it
 * has begun by a given time. Pure: the page draws it.
 */
// SPDX-License-Identifier: Apache-2.0
import type { BenchEvent, BenchPlan, Planned } from "../../wire/bench";

export type LaneKind = "fault" | "flag" | "operator";
export type Progress = "to come" | "under way" | "over";

export interface Lane {
  kind: LaneKind;
  what: string;
  from: number;
  /** Seconds; the end of the run where nothing else ends it. */
  to: number;
}

/** A flag stands until the next one; a fault without a length lasts to the end. */
export function lanesOf(plan: BenchPlan): Lane[] {
  const end = plan.duration_s;
  const lane = (kind: LaneKind, of: Planned, to: number): Lane => ({
    kind,
    what: of.what,
    from: Math.min(of.at_s, end),
    to: Math.min(to, end),
  });
  return [
    ...plan.flags.map((flag, i) => lane("flag", flag, plan.flags[i + 1]?.at_s ?? end)),
    ...plan.faults.map((fault) =>
      lane("fault", fault, fault.lasts_s ? fault.at_s + fault.lasts_s : end),
    ),
    ...plan.operator.map((word) => lane("operator", word, word.at_s)),
  ];
}

export function progressOf(lane: Lane, nowS: number): Progress {
  if (!(nowS >= lane.from)) return "to come";
  return nowS >= lane.to ? "over" : "under way";
}

/** Where on the axis, in percent. */
export const percent = (s: number, durationS: number): number =>
  durationS > 0 ? Math.min(Math.max((100 * s) / durationS, 0), 100) : 0;

/** Steps of the axis: as many as fit, at round numbers of seconds. */
export function axisOf(durationS: number, most = 8): number[] {
  const steps = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800, 3600, 7200];
  const step = steps.find((s) => durationS / s <= most) ?? durationS;
  const marks: number[] = [];
  for (let at = 0; at <= durationS; at += step) marks.push(at);
  return marks;
}

/** What really happened besides the plan: modes, laps, actions on processes. */
export const happened = (events: readonly BenchEvent[]): BenchEvent[] =>
  events.filter((event) => !["fault_begins", "fault_ends", "operator"].includes(event.kind));
