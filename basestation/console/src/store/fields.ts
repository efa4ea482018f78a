/**
 * The newest value of every field, in typed arrays: one slot a field, found by its path. Snapshots
 * are written in as they come; the screen reads what is there when it draws. Ages go on growing
 * between frames, and a base that fell silent makes every value stale, because a console that lost
 * its base knows nothing about the car.
 */
// SPDX-License-Identifier: Apache-2.0
import { ageMs } from "../wire/age";
import type { FieldInfo } from "../wire/messages";
import { Judgement, Quality, kNeverStatus } from "../wire/status";
import { kNothing, readInto } from "./reading";
import type { Reading } from "./reading";

const kIds = 65536;

export class Fields {
  readonly info: readonly FieldInfo[];
  readonly value: Float32Array;
  readonly status: Uint8Array;
  /** Age when the entry was made, and the base's time then. */
  readonly ageMs: Float32Array;
  readonly entryMs: Float64Array;
  /** How often a value was seen to arrive anew. */
  readonly arrivals: Uint32Array;
  /** Entries with an id that the catalogue does not have. */
  unknownIds = 0;

  private readonly slotOfId = new Int16Array(kIds).fill(-1);
  private readonly slotOfPath = new Map<string, number>();

  constructor(info: readonly FieldInfo[]) {
    this.info = info;
    this.value = new Float32Array(info.length).fill(NaN);
    this.status = new Uint8Array(info.length).fill(kNeverStatus);
    this.ageMs = new Float32Array(info.length).fill(Infinity);
    this.entryMs = new Float64Array(info.length);
    this.arrivals = new Uint32Array(info.length);
    info.forEach((field, slot) => {
      this.slotOfId[field.id] = slot;
      this.slotOfPath.set(field.path, slot);
    });
  }

  /** The slot of a path, -1 where the base has no such field. */
  slot(path: string): number {
    return this.slotOfPath.get(path) ?? -1;
  }

  slotOf(id: number): number {
    return this.slotOfId[id];
  }

  write(id: number, status: number, age: number, value: number, baseMs: number): void {
    const slot = this.slotOfId[id];
    if (slot < 0) {
      ++this.unknownIds;
      return;
    }
    const aged = ageMs(age);
    const carriedOn = this.ageMs[slot] + (baseMs - this.entryMs[slot]);
    // The steps of the age code are coarse: only a clear step back is an arrival.
    if (aged < carriedOn - Math.max(15, 0.3 * carriedOn)) ++this.arrivals[slot];
    this.value[slot] = value;
    this.status[slot] = status;
    this.ageMs[slot] = aged;
    this.entryMs[slot] = baseMs;
  }

  /** Fills `out` with the newest value of a slot as it is at the base's time `nowMs`. */
  read(slot: number, nowMs: number, silent: boolean, out: Reading): Reading {
    if (slot < 0) return Object.assign(out, kNothing);
    const ageMs = this.ageMs[slot] + Math.max(0, nowMs - this.entryMs[slot]);
    readInto(out, this.value[slot], this.status[slot], ageMs);
    if (silent && out.quality < Quality.stale) {
      out.quality = Quality.stale;
      out.judgement = Judgement.none;
    }
    return out;
  }
}
