/**
 * What the screen may say of a reading by its quality: the age as soon as it is not fresh, a colour
 * or a latch only while it is known. Beyond "late" nobody knows it any more; it stays readable and
 * claims nothing.
 */
// SPDX-License-Identifier: Apache-2.0
import type { LastStop } from "../store/car_session";
import type { Reading } from "../store/reading";
import { Quality } from "../wire/status";
import { ageText, kDash } from "./format";

/** How long the outcome of a press stands beside the buttons. */
export const kOutcomeMs = 4000;

const kWords = ["", "good", "warning", "bad"] as const;

/** The colour of a flag by a word of its label. */
const kFlagColours: readonly (readonly [RegExp, string])[] = [
  [/PURPLE/, "purple"],
  [/\bRED\b|STOP|KILL/, "red"],
  [/ORANGE/, "orange"],
  [/YELLOW/, "yellow"],
  [/GREEN/, "green"],
  [/CHEQUERED/, "chequered"],
  [/BLUE/, "blue"],
  [/BLACK/, "black"],
];

export const isKnown = (reading: Reading): boolean => reading.quality < Quality.stale;

/** The age beside what is late or stale; empty for what is fresh or was never heard. */
export function shownAge(reading: Reading): string {
  const old = reading.quality === Quality.late || reading.quality === Quality.stale;
  return old ? ageText(reading.ageMs) : "";
}

/** What a screen reader says of it. */
export function stateWord(reading: Reading): string {
  if (reading.quality === Quality.never) return "not received yet";
  if (reading.quality === Quality.stale) return "stale";
  return kWords[reading.judgement];
}

/** The colour of the cloth of a flag that is called so; "none" for one without. */
export const colourOfFlag = (label: string): string =>
  kFlagColours.find(([word]) => word.test(label))?.[1] ?? "none";

/** The same where the flag is known. */
export const flagColour = (reading: Reading, label: string | undefined): string =>
  label && isKnown(reading) ? colourOfFlag(label) : "none";

/** The word of a flag: kept while it is old, an en dash where it was never heard. */
export const flagWord = (reading: Reading, label: string | undefined): string =>
  reading.quality === Quality.never ? kDash : (label ?? kDash);

export interface StopOutcome {
  text: string;
  failed: boolean;
}

/**
 * What the car itself says about a stop, and what became of the press. A press that was not sent
 * comes first; a latch counts only while the car's word of it is known.
 */
export function stopOutcome(
  latch: Reading,
  label: string | undefined,
  last: LastStop | null,
  nowMs: number,
): StopOutcome {
  const recent = last !== null && nowMs - last.at < kOutcomeMs;
  if (recent && !last.sent) return { text: "NOT SENT: no base", failed: true };
  if (isKnown(latch) && latch.value > 0) return { text: `car: ${label ?? "stops"}`, failed: false };
  return { text: recent ? "sent to the base" : "", failed: false };
}
