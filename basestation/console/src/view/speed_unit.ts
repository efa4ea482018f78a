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

export const speedUnit = signal<SpeedUnit>(kSpeedUnits[0]);

export function nextSpeedUnit(): void {
  const at = kSpeedUnits.indexOf(speedUnit.value);
  speedUnit.value = kSpeedUnits[(at + 1) % kSpeedUnits.length];
}
