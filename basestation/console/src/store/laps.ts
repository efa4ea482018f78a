/**
 * The laps of one car: the table that the base tells, the points of those laps that were looked at,
 * and which two of them the operator compares.
 */
// SPDX-License-Identifier: Apache-2.0
import { computed, signal } from "@preact/signals";
import type { LapPoints, LapRow, Laps } from "../wire/laps";

/** A lap that is being driven is asked for again. */
const kAgainMs = 500;
/** The last points of a lap wait for the next sample: by then they have come. */
const kSettledMs = 1000;

interface Known {
  points: LapPoints | null;
  askedMs: number;
  final: boolean;
}

export class LapStore {
  readonly table = signal<Laps | null>(null);
  /** The lap that is looked at; null: the one that is driven at the moment shown. */
  readonly shown = signal<number | null>(null);
  /** The lap that it is compared with; null: the fastest complete one. */
  readonly reference = signal<number | null>(null);
  readonly referenceRow = computed(() => {
    const chosen = this.row(this.reference.value);
    return chosen ?? this.row(this.table.value?.best ?? null);
  });

  private readonly known = new Map<number, Known>();

  row(id: number | null): LapRow | null {
    return this.table.value?.laps.find((lap) => lap.id === id) ?? null;
  }

  /** The lap that is driven at this moment; the newest one before it where none is. */
  rowAt(ms: number): LapRow | null {
    return this.table.value?.laps.findLast((lap) => lap.begin_ms <= ms) ?? null;
  }

  points(id: number): LapPoints | null {
    return this.known.get(id)?.points ?? null;
  }

  /** Asks for the points of a lap where they are not here or have grown since. */
  want(row: LapRow, localMs: number, ask: (lap: number) => boolean): void {
    const known = this.known.get(row.id);
    if (known && (known.final || localMs - known.askedMs < kAgainMs)) return;
    if (!ask(row.id)) return;
    this.known.set(row.id, { points: known?.points ?? null, askedMs: localMs, final: false });
  }

  /** `whole`: of a recording, of which nothing more comes. */
  take(points: LapPoints, baseMs: number, whole: boolean): void {
    const known = this.known.get(points.lap);
    if (!known) return;
    known.points = points;
    const endMs = this.row(points.lap)?.end_ms ?? Infinity;
    known.final = whole || baseMs > endMs + kSettledMs;
  }

  /** A new connection: it may be another base, whose laps are others. */
  forget(): void {
    this.known.clear();
    this.table.value = null;
    this.shown.value = null;
    this.reference.value = null;
  }
}
