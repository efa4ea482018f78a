/**
 * The age byte of a snapshot entry: fine near zero, coarse where it no longer matters. 0..99 in
 * steps of 10 ms, 100..189 of 0.1 s from 1 s, 190..249 of 1 s from 10 s, 250..254 minutes from
 * 70 s, 255 never.
 */
// SPDX-License-Identifier: Apache-2.0

export const kAgeNever = 255;

/** Milliseconds of an age code; infinite for "never". */
export function ageMs(code: number): number {
  if (code < 100) return code * 10;
  if (code < 190) return 1000 + (code - 100) * 100;
  if (code < 250) return 10_000 + (code - 190) * 1000;
  if (code < kAgeNever) return 70_000 + (code - 250) * 60_000;
  return Infinity;
}
