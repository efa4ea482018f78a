/**
 * The last ten minutes of every field at the rate of the snapshots: a ring of rows, one column a
 * field, so that a plot reads one array and a paused console reads one row. The memory is taken
 * once, on the catalogue, and never grows.
 */
// SPDX-License-Identifier: Apache-2.0
import { kNeverStatus } from "../wire/status";
import type { Fields } from "./fields";
import { kNothing, readInto } from "./reading";
import type { Reading } from "./reading";

/** 10 minutes at 25 frames a second. */
export const kRows = 15_000;

export class History {
  readonly timeMs: Float64Array;
  readonly value: Float32Array[];
  readonly status: Uint8Array[];
  private readonly age: Float32Array[];
  private next = 0;
  size = 0;

  constructor(
    fields: number,
    readonly rows = kRows,
  ) {
    this.timeMs = new Float64Array(rows);
    this.value = Array.from({ length: fields }, () => new Float32Array(rows));
    this.status = Array.from({ length: fields }, () => new Uint8Array(rows));
    this.age = Array.from({ length: fields }, () => new Float32Array(rows));
  }

  /** Appends what the fields are at `baseMs`. Time that runs backwards starts the ring anew. */
  append(fields: Fields, baseMs: number): void {
    if (this.size > 0 && baseMs < this.newestMs()) this.size = 0;
    const row = this.next;
    this.timeMs[row] = baseMs;
    for (let slot = 0; slot < this.value.length; ++slot) {
      this.value[slot][row] = fields.value[slot];
      this.status[slot][row] = fields.status[slot];
      this.age[slot][row] = fields.ageMs[slot] + (baseMs - fields.entryMs[slot]);
    }
    this.next = (row + 1) % this.rows;
    this.size = Math.min(this.size + 1, this.rows);
  }

  /** The ring's index of the n-th row, 0 the oldest. */
  index(n: number): number {
    return (this.next - this.size + n + this.rows) % this.rows;
  }

  newestMs(): number {
    return this.size === 0 ? NaN : this.timeMs[this.index(this.size - 1)];
  }

  oldestMs(): number {
    return this.size === 0 ? NaN : this.timeMs[this.index(0)];
  }

  /** Position of the last row at or before `baseMs`; -1 where there is none. */
  find(baseMs: number): number {
    let low = 0;
    let high = this.size;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.timeMs[this.index(middle)] <= baseMs) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /** The value of a slot in the n-th row, as it was known then. */
  read(slot: number, n: number, out: Reading): Reading {
    if (slot < 0 || n < 0 || n >= this.size) return Object.assign(out, kNothing);
    const row = this.index(n);
    const status = this.status[slot][row];
    const ageMs = status === kNeverStatus ? Infinity : this.age[slot][row];
    return readInto(out, this.value[slot][row], status, ageMs);
  }
}
