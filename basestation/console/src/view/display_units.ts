/**
 * Quantities and sentences of the base as this page says them: speeds in the unit that its operator
 * reads, degrees with their sign. In a sentence the base writes a quantity as a number, a blank and
 * its unit.
 */
// SPDX-License-Identifier: Apache-2.0
import { fixed, unitText } from "./format";
import { speedUnit } from "./speed_unit";

const kQuantity = /([+\u2212-]?)(\d+(?:\.(\d+))?) (m\/s|degC)(?![\^\u00b2/\w])/g;

export function inDisplayUnits(text: string): string {
  return text.replace(kQuantity, (_, sign: string, digits: string, decimals = "", unit: string) => {
    const signed = sign.replace("-", "\u2212");
    if (unit !== "m/s") return `${signed}${digits} ${unitText(unit)}`;
    const { perMps, name } = speedUnit.value;
    return `${signed}${fixed(Number(digits) * perMps, decimals.length)} ${name}`;
  });
}

/** To three digits; empty where there is no number. */
export function quantityText(value: number | null | undefined, unit = ""): string {
  if (typeof value !== "number" || !Number.isFinite(value)) return "";
  const isSpeed = unit === "m/s";
  const shown = isSpeed ? value * speedUnit.value.perMps : value;
  const size = Math.abs(shown);
  const decimals = Number.isInteger(shown) ? 0 : size < 1 ? 3 : size < 10 ? 2 : 1;
  return `${fixed(shown, decimals)} ${isSpeed ? speedUnit.value.name : unitText(unit)}`.trim();
}
