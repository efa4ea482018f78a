/**
 * The base's side of the wire contract, written a second time for the tests: ages, entries, frames.
 */
// SPDX-License-Identifier: Apache-2.0

export const kNeverAge = 255;

/** The age code of a time: the coarsest step that is not younger. */
export function ageCode(ms) {
  if (!Number.isFinite(ms)) return kNeverAge;
  if (ms < 1000) return Math.floor(ms / 10);
  if (ms < 10_000) return 100 + Math.floor((ms - 1000) / 100);
  if (ms < 70_000) return 190 + Math.floor((ms - 10_000) / 1000);
  return Math.min(250 + Math.floor((ms - 70_000) / 60_000), 254);
}

export const kFresh = 0;
export const kLate = 1;
export const kStale = 2;
export const kNever = 3;
export const kGood = 1;
export const kWarning = 2;
export const kBad = 3;

export const statusByte = (quality, judgement = 0, unknown = false) =>
  quality | ((quality >= kStale ? 0 : judgement) << 2) | (unknown ? 32 : 0);

function head(bytes, { kind, car, flags, count, sequence, dropped, timeMs }) {
  const view = new DataView(bytes);
  view.setUint8(0, kind);
  view.setUint8(1, 1);
  view.setUint8(2, car);
  view.setUint8(3, flags);
  view.setUint16(4, count, true);
  view.setUint32(8, sequence, true);
  view.setUint32(12, dropped, true);
  view.setBigUint64(16, BigInt(Math.round(timeMs * 1e6)), true);
  return view;
}

/** A snapshot of entries `{id, status, age, value}`. */
export function snapshot(entries, { car = 7, flags = 2, sequence = 0, dropped = 0, timeMs }) {
  const bytes = new ArrayBuffer(24 + 8 * entries.length);
  const view = head(bytes, {
    kind: 1,
    car,
    flags,
    count: entries.length,
    sequence,
    dropped,
    timeMs,
  });
  entries.forEach(({ id, status, age, value }, i) => {
    view.setUint16(24 + 8 * i, id, true);
    view.setUint8(26 + 8 * i, status);
    view.setUint8(27 + 8 * i, age);
    view.setFloat32(28 + 8 * i, value, true);
  });
  return Buffer.from(bytes);
}

/** The answer to a history request: points `{timeS, value, quality}`. */
export function history(field, points, { car = 7, timeMs }) {
  const bytes = new ArrayBuffer(32 + 16 * points.length);
  const view = head(bytes, {
    kind: 2,
    car,
    flags: 0,
    count: 1,
    sequence: 0,
    dropped: 0,
    timeMs,
  });
  view.setUint16(24, field, true);
  view.setUint32(28, points.length, true);
  points.forEach(({ timeS, value, quality }, i) => {
    view.setFloat64(32 + 16 * i, timeS, true);
    view.setFloat32(40 + 16 * i, value, true);
    view.setUint8(44 + 16 * i, quality);
  });
  return Buffer.from(bytes);
}

/** The points of a lap: columns of equal length. */
export function lap(number, columns, { car = 7, timeMs, stepM = 5 }) {
  const bytes = new ArrayBuffer(40 + 4 * columns.length * columns[0].length);
  const view = head(bytes, {
    kind: 3,
    car,
    flags: 0,
    count: 1,
    sequence: 0,
    dropped: 0,
    timeMs,
  });
  view.setUint32(24, number, true);
  view.setUint32(28, columns.length, true);
  view.setUint32(32, columns[0].length, true);
  view.setFloat32(36, stepM, true);
  columns.flat().forEach((value, i) => view.setFloat32(40 + 4 * i, value, true));
  return Buffer.from(bytes);
}
