/**
 * The unit in which speeds are shown: race control speaks miles an hour, the car metres a second.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";

export interface SpeedUnit {
  name: string;
  perMps: number;
}

export const kSpeedUnits: readonly SpeedUnit[] = [
  { name: "mph", perMps: 2.2369362920544 },
  { name: "km/h", perMps: 3.6 },
  { name: "m/s", perMps: 1 },
];

const kKept = "pitwall.speed_unit";

/** Storage may be refused: then the choice lasts as long as the page. */
function kept(): SpeedUnit {
  try {
    const name = localStorage.getItem(kKept);
    return kSpeedUnits.find((unit) => unit.name === name) ?? kSpeedUnits[0];
  } catch {
    return kSpeedUnits[0];
  }
}

export const speedUnit = signal<SpeedUnit>(kept());

export function nextSpeedUnit(): void {
  const at = kSpeedUnits.indexOf(speedUnit.value);
  speedUnit.value = kSpeedUnits[(at + 1) % kSpeedUnits.length];
  try {
    localStorage.setItem(kKept, speedUnit.value.name);
  } catch {
    // The choice then lasts as long as the page.
  }
}
