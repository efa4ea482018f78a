/**
 * Laps laid over each other by distance: for each of the newest laps one column over the stations
 * of the track, so that two passes of the same corner stand at the same place. Works on the rows of
 * any car. A stretch that was stale, or over which the car was not heard, is a gap.
 */
// SPDX-License-Identifier: Apache-2.0
import type { History } from "../../store/history";
import { Quality } from "../../wire/status";
import { kGapMs } from "./series";
import type { Column } from "./series";

/** Between two points of a column. */
export const kStepM = 5;

export interface LapSlots {
  station: number;
  lap: number;
}

export interface Lap {
  /** As the car counts, NaN where it does not. */
  number: number;
  /** Rows of the history, the last one included. */
  first: number;
  last: number;
}

export interface LapColumns {
  stationM: number[];
  laps: Lap[];
  /** For each field one column a lap, the newest lap first. */
  values: Column[][];
}

const known = (history: History, slot: number, row: number): number =>
  slot >= 0 && (history.status[slot][row] & 3) < Quality.stale ? history.value[slot][row] : NaN;

/** The laps of the rows, newest first; a new one begins where the station jumps back. */
export function lapsOf(history: History, slots: LapSlots, lengthM: number, endMs: number): Lap[] {
  const laps: Lap[] = [];
  let before = NaN;
  const end = history.find(endMs);
  for (let n = 0; n <= end; ++n) {
    const row = history.index(n);
    const station = known(history, slots.station, row);
    if (!Number.isFinite(station)) continue;
    const number = known(history, slots.lap, row);
    const current = laps[0];
    if (!current || station < before - lengthM / 2) laps.unshift({ number, first: n, last: n });
    else current.last = n;
    // The count may come in a packet after the station.
    if (Number.isFinite(number)) laps[0].number = number;
    before = station;
  }
  return laps;
}

/** Fills the points between two known places of a lap; linear, as the car moved in between. */
function fill(column: Column, fromM: number, from: number, toM: number, to: number): void {
  for (let i = Math.ceil(fromM / kStepM); i * kStepM <= toM && i < column.length; ++i) {
    const share = toM > fromM ? (i * kStepM - fromM) / (toM - fromM) : 1;
    column[i] = from + share * (to - from);
  }
}

function lapColumn(
  history: History,
  slots: LapSlots,
  slot: number,
  lap: Lap,
  points: number,
): Column {
  const column: Column = new Array<number | null>(points).fill(null);
  let [atM, at, atMs] = [NaN, NaN, -Infinity];
  for (let n = lap.first; n <= lap.last; ++n) {
    const row = history.index(n);
    const station = known(history, slots.station, row);
    const value = known(history, slot, row);
    // The snapshots are more frequent than the station: only a new place is a point.
    if (!Number.isFinite(station + value) || station <= atM) continue;
    const timeMs = history.timeMs[row];
    if (timeMs - atMs <= kGapMs) fill(column, atM, at, station, value);
    else fill(column, station, value, station, value);
    [atM, at, atMs] = [station, value, timeMs];
  }
  return column;
}

/** At most `most` laps up to a moment, of the fields in these slots. */
export function lapColumns(
  history: History,
  slots: LapSlots,
  fields: readonly number[],
  lengthM: number,
  endMs: number,
  most: number,
): LapColumns {
  const points = Math.max(0, Math.floor(lengthM / kStepM)) + 1;
  const laps = lapsOf(history, slots, lengthM, endMs).slice(0, most);
  return {
    stationM: Array.from({ length: points }, (_, i) => i * kStepM),
    laps,
    values: fields.map((slot) => laps.map((lap) => lapColumn(history, slots, slot, lap, points))),
  };
}
