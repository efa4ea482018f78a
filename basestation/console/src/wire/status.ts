/**
 * The status byte of a field: its quality, what the base judges of it, and whether the car itself
 * says that it does not know.
 */
// SPDX-License-Identifier: Apache-2.0

export const enum Quality {
  fresh = 0,
  late = 1,
  stale = 2,
  never = 3,
}

export const enum Judgement {
  none = 0,
  good = 1,
  warning = 2,
  bad = 3,
}

export const kQualityNames = ["fresh", "late", "stale", "never"] as const;
export const kJudgementNames = ["none", "good", "warning", "bad"] as const;

export const kNeverStatus = Quality.never;

export const qualityOf = (status: number): Quality => status & 3;
export const saysUnknown = (status: number): boolean => (status & 32) !== 0;

/** A stale value has no judgement, whatever the byte says: an old "good" is no good. */
export function judgementOf(status: number): Judgement {
  if (qualityOf(status) >= Quality.stale) return Judgement.none;
  const judgement = (status >> 2) & 7;
  return judgement <= Judgement.bad ? judgement : Judgement.none;
}
