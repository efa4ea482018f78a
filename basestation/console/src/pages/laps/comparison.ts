/**
 * One lap against another, place by place: what is drawn over the stations of the track. What was
 * not received of either lap is a gap.
 */
// SPDX-License-Identifier: Apache-2.0
import type { LapColumn, LapPoints, LapRow } from "../../wire/laps";

export type Column = (number | null)[];

export interface Compared {
  row: LapRow;
  points: LapPoints;
}

export const columnOf = ({ points }: Compared, name: LapColumn, factor = 1): Column =>
  Array.from(points.columns[name], (value) => (Number.isFinite(value) ? value * factor : null));

/**
 * How much later than in the reference the car was at each station, both times counted from the
 * line: negative is gained. Unknown where the start of either was not seen.
 */
export function deltaOf(lap: Compared, reference: Compared): Column {
  const [own, other] = [lap.points.columns.time, reference.points.columns.time];
  const counts = lap.row.start_seen && reference.row.start_seen;
  return Array.from(own, (at, i) => {
    const delta = counts ? at - other[i] : NaN;
    return Number.isFinite(delta) ? delta : null;
  });
}

/** The last point at which the car had been at this moment; -1: none. */
export function pointAt({ row, points }: Compared, ms: number): number {
  const sinceS = (ms - row.begin_ms) / 1000;
  return points.columns.time.findLastIndex((at) => at <= sinceS);
}

/** Why there is no delta; empty: there is one. */
export function noDeltaText(lap: LapRow | null, reference: LapRow | null): string {
  if (!lap) return "no lap";
  if (!reference) return "no complete lap to compare with";
  const unseen = [lap, reference].find((row) => !row.start_seen);
  return unseen ? `the start of lap ${unseen.id} was not seen` : "";
}

function missingOf({ start_seen, finish_seen, end_ms }: LapRow): string {
  if (end_ms === null) return start_seen ? "not finished" : "not finished, start not seen";
  if (!start_seen && !finish_seen) return "incomplete: start and finish not seen";
  if (!start_seen) return "incomplete: start not seen";
  return finish_seen ? "" : "incomplete: finish not seen";
}

/** Why a lap has no time, or what is missing of it; empty: nothing. */
export function remarkOf(row: LapRow): string {
  const gap = row.gap_s > 0 ? `gap of ${row.gap_s.toFixed(1)} s` : "";
  return [missingOf(row), gap].filter(Boolean).join(", ");
}
