/**
 * Columns for a chart out of the ring of rows: a stretch that is stale or was not received is a
 * gap (null), never a line across it; many rows are thinned to what the pixels can show, keeping
 * the extremes of each bucket.
 */
// SPDX-License-Identifier: Apache-2.0
import type { History } from "../../store/history";
import { Quality } from "../../wire/status";

/** Rows further apart than this are a gap: nothing came in between. */
export const kGapMs = 500;

/** The base thins its memory to the points that were asked for: a wider gap there. */
const kEarlierGapMs = 2000;

export type Column = (number | null)[];

export interface Columns {
  timeS: number[];
  values: Column[];
}

/** What came before this console's own rows, as the base remembers it. */
export interface Earlier {
  timeS: Float64Array;
  value: Float32Array;
  quality: Uint8Array;
}

const shown = (value: number, status: number): number | null =>
  (status & 3) < Quality.stale && Number.isFinite(value) ? value : null;

/** Of rows n and m of one bucket: which has the larger swing of the first column that has any. */
function extremes(history: History, slots: readonly number[], from: number, to: number): number[] {
  const slot = slots.find((s) => s >= 0);
  if (slot === undefined) return [from];
  let [low, high] = [from, from];
  for (let n = from; n < to; ++n) {
    const value = history.value[slot][history.index(n)];
    if (value < history.value[slot][history.index(low)]) low = n;
    if (value > history.value[slot][history.index(high)]) high = n;
  }
  return low === high ? [low] : low < high ? [low, high] : [high, low];
}

/** The rows between two moments, at most about `points` of them. */
export function columns(
  history: History,
  slots: readonly number[],
  fromMs: number,
  toMs: number,
  points: number,
): Columns {
  const out: Columns = { timeS: [], values: slots.map(() => []) };
  const end = history.find(toMs) + 1;
  const begin = Math.max(history.find(fromMs), 0);
  const bucket = Math.max(1, Math.floor((2 * (end - begin)) / points));
  let lastMs = NaN;
  const push = (timeMs: number, value: (slot: number) => number | null) => {
    out.timeS.push(timeMs / 1000);
    slots.forEach((slot, i) => out.values[i].push(slot < 0 ? null : value(slot)));
    lastMs = timeMs;
  };
  const first = bucket === 1 ? begin : begin - (begin % bucket);
  for (let n = Math.max(first, 0); n < end; n += bucket) {
    const rows = bucket === 1 ? [n] : extremes(history, slots, n, Math.min(n + bucket, end));
    for (const each of rows) {
      const row = history.index(each);
      const timeMs = history.timeMs[row];
      const apart = bucket * 40 + kGapMs;
      if (timeMs - lastMs > apart) push(lastMs + 1, () => null);
      push(timeMs, (slot) => shown(history.value[slot][row], history.status[slot][row]));
    }
  }
  return out;
}

/** The value of a remembered field at a moment: its last point before, unless that is too old. */
class Follower {
  private at = 0;

  constructor(private readonly points: Earlier | null) {}

  value(timeS: number): number | null {
    const { points } = this;
    if (points === null) return null;
    while (this.at + 1 < points.timeS.length && points.timeS[this.at + 1] <= timeS) ++this.at;
    const age = timeS - (points.timeS[this.at] ?? Infinity);
    if (!(age >= 0 && age * 1000 <= kEarlierGapMs)) return null;
    return shown(points.value[this.at], points.quality[this.at]);
  }
}

/** What the base remembers of the fields, in front of our own rows. */
export function withEarlier(
  after: Columns,
  earlier: readonly (Earlier | null)[],
  fromS: number,
): Columns {
  const until = after.timeS[0] ?? Infinity;
  const moments = new Set<number>();
  for (const points of earlier) {
    for (const at of points?.timeS ?? []) if (at >= fromS && at < until) moments.add(at);
  }
  const timeS = [...moments].sort((a, b) => a - b);
  const followers = earlier.map((points) => new Follower(points));
  const values = followers.map((follower) => timeS.map((at) => follower.value(at)));
  const last = timeS.at(-1);
  if (last !== undefined && (until - last) * 1000 > kEarlierGapMs) {
    timeS.push(last + 0.001);
    for (const column of values) column.push(null);
  }
  return {
    timeS: [...timeS, ...after.timeS],
    values: values.map((column, i) => [...column, ...after.values[i]]),
  };
}
