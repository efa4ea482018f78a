/**
 * One value as it is to be drawn: what an entry of the base says, with its age.
 */
// SPDX-License-Identifier: Apache-2.0
import { Judgement, Quality, judgementOf, qualityOf, saysUnknown } from "../wire/status";

export interface Reading {
  value: number;
  quality: Quality;
  judgement: Judgement;
  unknown: boolean;
  ageMs: number;
}

/** Never heard of, or no such field. */
export const kNothing: Readonly<Reading> = {
  value: NaN,
  quality: Quality.never,
  judgement: Judgement.none,
  unknown: false,
  ageMs: Infinity,
};

/** Fills `out` with a value and what its status byte says of it. */
export function readInto(out: Reading, value: number, status: number, ageMs: number): Reading {
  out.value = value;
  out.quality = qualityOf(status);
  out.judgement = judgementOf(status);
  out.unknown = saysUnknown(status);
  out.ageMs = ageMs;
  return out;
}
