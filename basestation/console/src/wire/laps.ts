/**
 * Laps as the base tells them: a table by text, and by a binary frame what was measured over the
 * stations of one lap.
 */
// SPDX-License-Identifier: Apache-2.0
import { kHeadBytes } from "./frame";

export interface LapRow {
  id: number;
  /** The count of race control in this lap; null: none came. */
  number: number | null;
  begin_ms: number;
  /** Null: it is being driven. */
  end_ms: number | null;
  /** Null: its start or its finish was not seen. */
  time_s: number | null;
  start_seen: boolean;
  finish_seen: boolean;
  /** The longest time inside it without a station. */
  gap_s: number;
}

export interface Laps {
  length_m: number;
  step_m: number;
  /** The fastest complete lap. */
  best: number | null;
  /** Oldest first. */
  laps: LapRow[];
}

/** The columns in their order on the wire; NaN: not received. */
export const kLapColumns = ["time", "speed", "crossTrack", "throttle", "brake"] as const;
export type LapColumn = (typeof kLapColumns)[number];

export interface LapPoints {
  lap: number;
  stepM: number;
  columns: Record<LapColumn, Float32Array>;
}

const kLapHeadBytes = 16;

/** The points of a lap frame; null where the length is wrong. There may be more columns. */
export function readLap(view: DataView): LapPoints | null {
  if (view.byteLength < kHeadBytes + kLapHeadBytes) return null;
  const columns = view.getUint32(kHeadBytes + 4, true);
  const points = view.getUint32(kHeadBytes + 8, true);
  const begin = kHeadBytes + kLapHeadBytes;
  if (columns < kLapColumns.length || view.byteLength !== begin + columns * points * 4) return null;
  const column = (n: number) =>
    Float32Array.from({ length: points }, (_, i) =>
      view.getFloat32(begin + (n * points + i) * 4, true),
    );
  return {
    lap: view.getUint32(kHeadBytes, true),
    stepM: view.getFloat32(kHeadBytes + 12, true),
    columns: Object.fromEntries(kLapColumns.map((name, n) => [name, column(n)])) as Record<
      LapColumn,
      Float32Array
    >,
  };
}
