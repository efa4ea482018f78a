/**
 * Numbers as an engineer reads them: as many decimals as the field's resolution carries, labels
 * where a number is a name, set bits by their names, ages in three digits.
 */
// SPDX-License-Identifier: Apache-2.0
import type { FieldInfo } from "../wire/messages";

/** Nothing was ever heard. */
export const kDash = "\u2013";
const kMostDecimals = 4;

export function decimalsOf(resolution: number): number {
  if (!(resolution > 0)) return 1;
  return Math.min(Math.max(Math.ceil(-Math.log10(resolution) - 1e-6), 0), kMostDecimals);
}

/** A fixed count of decimals with a true minus sign, and no "-0.0". */
export function fixed(value: number, decimals: number): string {
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? `\u2212${text}` : text;
}

function bitsText(value: number, labels: readonly string[]): string {
  const set = labels.filter((_, bit) => Math.floor(value / 2 ** bit) % 2 === 1);
  return set.length === 0 ? "none" : set.join(", ");
}

/** The value without its unit; an en dash where there is none. */
export function valueText(info: FieldInfo, value: number, decimals?: number): string {
  if (!Number.isFinite(value)) return kDash;
  if (info.labels?.length) {
    if (info.unit === "bits") return bitsText(value, info.labels);
    return info.labels[value] ?? String(value);
  }
  if (info.kind === "integer") return fixed(value, 0);
  return fixed(value, decimals ?? decimalsOf(info.resolution));
}

const kUnits: Record<string, string> = {
  degC: "\u00b0C",
  "m/s^2": "m/s\u00b2",
  bits: "",
  us: "\u00b5s",
};

export const unitText = (unit: string): string => kUnits[unit] ?? unit;

export function ageText(ms: number): string {
  if (!Number.isFinite(ms)) return "never";
  if (ms < 1000) return `${Math.round(ms / 10) * 10} ms`;
  if (ms < 10_000) return `${(ms / 1000).toFixed(1)} s`;
  if (ms < 100_000) return `${Math.round(ms / 1000)} s`;
  return `${Math.round(ms / 60_000)} min`;
}

const two = (n: number): string => String(Math.floor(n)).padStart(2, "0");

/** Time of day, UTC, to the second or to some of its decimals. */
export function clockText(utcMs: number, decimals = 0): string {
  if (!Number.isFinite(utcMs)) return kDash;
  const length = decimals > 0 ? "HH:MM:SS.".length + decimals : "HH:MM:SS".length;
  return new Date(utcMs).toISOString().slice("YYYY-MM-DDT".length).slice(0, length);
}

/** A duration as m:ss or h:mm:ss. */
export function durationText(ms: number): string {
  if (!Number.isFinite(ms)) return kDash;
  const s = Math.max(0, ms) / 1000;
  const rest = `${two((s / 60) % 60)}:${two(s % 60)}`;
  return s < 3600 ? rest.replace(/^0/, "") : `${Math.floor(s / 3600)}:${rest}`;
}

/** A lap time as m:ss with decimals. */
export function lapTimeText(seconds: number, decimals: number): string {
  if (!Number.isFinite(seconds)) return kDash;
  const rounded = Number(seconds.toFixed(decimals));
  const rest = (rounded % 60).toFixed(decimals).padStart(3 + decimals, "0");
  return `${Math.floor(rounded / 60)}:${rest}`;
}

export const lapText = (seconds: number): string => lapTimeText(seconds, 2);

/** A difference, with its sign; none at zero. */
export function signedText(value: number, decimals: number): string {
  const text = fixed(value, decimals);
  return value > 0 && Number(text) !== 0 ? `+${text}` : text;
}

/** Whole numbers in their order, a run of them as its ends: "1 ... 9, 0". */
export function runsText(numbers: readonly number[]): string {
  const runs: number[][] = [];
  for (const number of numbers) {
    const run = runs.at(-1);
    if (run?.at(-1) === number - 1) run?.push(number);
    else runs.push([number]);
  }
  return runs
    .map((run) => (run.length > 2 ? `${run[0]} \u2026 ${run.at(-1)}` : run.join(", ")))
    .join(", ");
}
