/**
 * Binary frames of the base: a head of 24 bytes, then the entries of a snapshot or the points of a
 * history. Little-endian. A frame that is not exactly what its head says is refused whole; the
 * caller counts it.
 */
// SPDX-License-Identifier: Apache-2.0

export const kHeadBytes = 24;
const kVersion = 1;
const kEntryBytes = 8;
const kPointBytes = 16;

export const enum Kind {
  snapshot = 1,
  history = 2,
  lap = 3,
}

export interface Head {
  kind: Kind;
  car: number;
  urgent: boolean;
  full: boolean;
  count: number;
  sequence: number;
  dropped: number;
  timeMs: number;
}

/** Receives the entries of a snapshot; a plain call per entry, so that nothing is allocated. */
export type EntrySink = (field: number, status: number, age: number, value: number) => void;

export interface History {
  field: number;
  timeS: Float64Array;
  value: Float32Array;
  quality: Uint8Array;
}

/** The head, or null where these bytes are no frame that we know. */
export function readHead(view: DataView): Head | null {
  if (view.byteLength < kHeadBytes) return null;
  const kind = view.getUint8(0);
  if (view.getUint8(1) !== kVersion || kind < Kind.snapshot || kind > Kind.lap) return null;
  const flags = view.getUint8(3);
  return {
    kind,
    car: view.getUint8(2),
    urgent: (flags & 1) !== 0,
    full: (flags & 2) !== 0,
    count: view.getUint16(4, true),
    sequence: view.getUint32(8, true),
    dropped: view.getUint32(12, true),
    timeMs: (view.getUint32(20, true) * 2 ** 32 + view.getUint32(16, true)) / 1e6,
  };
}

/** Hands every entry of a snapshot to the sink; false, and no call, where the length is wrong. */
export function readSnapshot(view: DataView, head: Head, sink: EntrySink): boolean {
  if (view.byteLength !== kHeadBytes + head.count * kEntryBytes) return false;
  for (let i = 0, at = kHeadBytes; i < head.count; ++i, at += kEntryBytes) {
    sink(
      view.getUint16(at, true),
      view.getUint8(at + 2),
      view.getUint8(at + 3),
      view.getFloat32(at + 4, true),
    );
  }
  return true;
}

/** The points of a history frame; null where the length is wrong. */
export function readHistory(view: DataView): History | null {
  if (view.byteLength < kHeadBytes + 8) return null;
  const points = view.getUint32(kHeadBytes + 4, true);
  if (view.byteLength !== kHeadBytes + 8 + points * kPointBytes) return null;
  const history: History = {
    field: view.getUint16(kHeadBytes, true),
    timeS: new Float64Array(points),
    value: new Float32Array(points),
    quality: new Uint8Array(points),
  };
  for (let i = 0, at = kHeadBytes + 8; i < points; ++i, at += kPointBytes) {
    history.timeS[i] = view.getFloat64(at, true);
    history.value[i] = view.getFloat32(at + 8, true);
    history.quality[i] = view.getUint8(at + 12) & 3;
  }
  return history;
}
