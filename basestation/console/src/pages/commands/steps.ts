/**
 * The ladder of a command: which steps there are, in which order, and which of them still wait for
 * the operator.
 */
// SPDX-License-Identifier: Apache-2.0
import { fixed, unitText } from "../../view/format";
import { speedUnit } from "../../view/speed_unit";
import type { CommandInfo, CommandStep } from "../../wire/messages";

export const kClimb = ["staged", "gated", "sent", "received", "applied"] as const;
export const kFalls = ["refused", "expired", "superseded", "cancelled"] as const;

export const isPending = (step: CommandStep): boolean =>
  step.step === "staged" || step.step === "gated";

export const isFallen = (step: CommandStep): boolean => kFalls.some((name) => name === step.step);

/** How far a command got, counted in steps. */
export const rung = (step: CommandStep): number =>
  Math.max(
    kClimb.findIndex((name) => name === step.step),
    ...kClimb.map((name, i) => (step.times_ms?.[name] !== undefined ? i : -1)),
  );

/** The argument as the operator wrote it: labels by name, speeds in the shown unit. */
export function argumentText(step: CommandStep, infos: readonly CommandInfo[]): string {
  const info = infos.find((command) => command.name === step.name);
  if (info?.labels?.length) {
    if (info.unit !== "bits") return info.labels[step.argument] ?? String(step.argument);
    return (
      info.labels.filter((_, bit) => Math.floor(step.argument / 2 ** bit) % 2).join(", ") || "none"
    );
  }
  if (info?.unit === "m/s") {
    return `${fixed(step.argument * speedUnit.value.perMps, 0)} ${speedUnit.value.name}`;
  }
  return `${step.argument}${info?.unit ? ` ${unitText(info.unit)}` : ""}`;
}
