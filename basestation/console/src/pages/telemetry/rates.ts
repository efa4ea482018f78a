/**
 * How often each field arrives, counted over the last seconds, and the extremes of its last minute.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Fields } from "../../store/fields";
import type { History } from "../../store/history";
import { Quality } from "../../wire/status";

const kSamples = 5;

/** Arrivals of each field at the last few samples; a sample a second. */
export class RateTable {
  private samples: { atMs: number; arrivals: Uint32Array }[] = [];

  sample(fields: Fields, nowMs = performance.now()): void {
    const newest = this.samples.at(-1);
    if (newest && newest.arrivals.length !== fields.arrivals.length) this.samples = [];
    this.samples.push({ atMs: nowMs, arrivals: fields.arrivals.slice() });
    if (this.samples.length > kSamples) this.samples.shift();
  }

  /** Arrivals a second; NaN until two samples are there. */
  rate(slot: number): number {
    const [first, last] = [this.samples[0], this.samples.at(-1)];
    if (!first || !last || last.atMs <= first.atMs) return NaN;
    return ((last.arrivals[slot] - first.arrivals[slot]) * 1000) / (last.atMs - first.atMs);
  }
}

export const rateTable = new RateTable();

/** Least and most of a field over the rows after `fromMs`; null where it never was known. */
export function extremes(
  history: History,
  slot: number,
  fromMs: number,
): { least: number; most: number } | null {
  let [least, most] = [Infinity, -Infinity];
  for (let n = Math.max(history.find(fromMs), 0); n < history.size; ++n) {
    const row = history.index(n);
    if ((history.status[slot][row] & 3) >= Quality.stale) continue;
    const value = history.value[slot][row];
    if (value < least) least = value;
    if (value > most) most = value;
  }
  return least <= most ? { least, most } : null;
}
