/**
 * The unit in which a field is shown, and its value in it: speeds in the operator's unit, angles in
 * degrees, anything else as the base has it. The one display rule of plots, tables and tiles.
 */
// SPDX-License-Identifier: Apache-2.0
import type { FieldInfo } from "../wire/messages";
import { decimalsOf, unitText, valueText } from "./format";
import { speedUnit } from "./speed_unit";

export interface ShownUnit {
  name: string;
  /** What a value of the base is multiplied by. */
  factor: number;
}

const kDegreesPerRadian = 180 / Math.PI;

export function shownUnit(unit: string): ShownUnit {
  if (unit === "m/s") return { name: speedUnit.value.name, factor: speedUnit.value.perMps };
  if (unit === "rad") return { name: "\u00b0", factor: kDegreesPerRadian };
  return { name: unitText(unit), factor: 1 };
}

/** The digits of a value in the unit that is shown; an en dash where there is none. */
export function shownDigits(info: FieldInfo, value: number, decimals?: number): string {
  const { factor } = shownUnit(info.unit);
  return valueText(info, value * factor, decimals ?? decimalsOf(info.resolution * factor));
}

/** The same with its unit; a degree sign stands at the digits. */
export function shownText(info: FieldInfo, value: number): string {
  const { name } = shownUnit(info.unit);
  const blank = name === "" || name === "\u00b0" ? "" : " ";
  return `${shownDigits(info, value)}${blank}${name}`;
}
