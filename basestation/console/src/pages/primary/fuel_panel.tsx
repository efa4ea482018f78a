/**
 * Fuel in what matters: laps, and attempts of two laps with the way home after them.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { Bar } from "../../view/bar";
import { Tile } from "../../view/value";

const kTankLitres = 45;

export function FuelPanel() {
  const fuel = session.fuel.value;
  const estimated = fuel?.estimated ?? false;
  const text = fuel && (fuel.text !== "unknown" ? fuel.text : "unknown: enter what is in the tank");
  return (
    <div class="fuel-body">
      <div class="tiles four">
        <Tile label="attempts" path="derived.fuel_attempts" decimals={0} big />
        <Tile label="laps" path="derived.fuel_laps" decimals={1} big />
        <Tile
          label={estimated ? "level, ESTIMATE" : "level"}
          path="derived.fuel_level"
          decimals={1}
        />
        <Tile label="per lap" path="derived.fuel_per_lap" decimals={2} />
      </div>
      <Bar path="derived.fuel_level" label="fuel level" max={kTankLitres} />
      {text && (
        <p class="note">
          {estimated && <b>ESTIMATE </b>}
          {text}
        </p>
      )}
    </div>
  );
}
