/**
 * Why the car drives no faster, and on which line: the planner's names in the words of an operator.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import type { FieldInfo } from "../../wire/messages";

/** By the planner's label; one that is not here is shown as the car names it. */
const kReasons: Record<string, string> = {
  "-": "not known",
  "no position": "car does not know its position",
  "no race control": "nothing received from race control",
  "no flag": "no flag shown",
  "unknown flag": "flag not understood",
  red: "red flag",
  orange: "orange flag",
  black: "black flag",
  stop: "stop flag",
  chequered: "chequered flag",
  caution: "caution",
  green: "green flag: the car's own limit",
  "round speed": "round speed of race control",
  operator: "limit of the operator",
  line: "curve ahead: line and grip",
  "declined: fuel": "ATTEMPT DECLINED: not enough fuel",
  "fuel for the way home": "FUEL: for the way home only",
};

export function reasonText(value: number, info: FieldInfo): string {
  const label = info.labels?.[value] ?? String(value);
  return kReasons[label] ?? label;
}

/** The line's name where the track has it, else its number. */
export function lineText(value: number): string {
  return session.track.value?.lines[value]?.name ?? `number ${value}`;
}
