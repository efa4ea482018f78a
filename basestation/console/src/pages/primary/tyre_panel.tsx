/**
 * Four tyres as they stand on the car: carcass temperature large, pressure and tread beside it, and
 * the temperature that the commanded speed needs.
 */
// SPDX-License-Identifier: Apache-2.0
import { Bar } from "../../view/bar";
import { unitText, valueText } from "../../view/format";
import { Tile, Value } from "../../view/value";
import type { TextOf } from "../../view/value";

const kWheels = [
  ["front_left", "FL"],
  ["front_right", "FR"],
  ["rear_left", "RL"],
  ["rear_right", "RR"],
] as const;

const kHottestC = 130;
/** What the gate asks for at a speed that any tyre may go. */
const kNoGateC = -40;

const gateText: TextOf = (value, info) =>
  value <= kNoGateC ? "none" : `${valueText(info, value, 0)} ${unitText(info.unit)}`;

function Tyre({ wheel, name }: { wheel: string; name: string }) {
  return (
    <div class="tyre" role="group" aria-label={`tyre ${name}`}>
      <span class="label">{name}</span>
      <Value path={`tyres.temperature_${wheel}`} decimals={0} class="large" />
      <span class="details">
        <Value path={`tyres.pressure_${wheel}`} decimals={0} />
        <span class="tread">
          <Value path={`tread.inner_${wheel}`} decimals={0} unit={false} />
          <i class="slash">/</i>
          <Value path={`tread.outer_${wheel}`} decimals={0} unit={"\u00b0"} />
        </span>
      </span>
      <Bar
        path={`tyres.temperature_${wheel}`}
        label={`temperature ${name}`}
        max={kHottestC}
        ticks={[{ path: "derived.tyre_gate", label: "needed for the commanded speed" }]}
      />
    </div>
  );
}

export function TyrePanel() {
  return (
    <div class="tyre-body">
      {kWheels.map(([wheel, name]) => (
        <Tyre key={wheel} wheel={wheel} name={name} />
      ))}
      <div class="tiles three">
        <Tile label="coldest" path="derived.tyre_min" decimals={0} />
        <Tile label="gate" path="derived.tyre_gate" text={gateText} unit={false} />
        <Tile label="slip rear" path="derived.slip" scale={100} decimals={1} unit="%" />
      </div>
    </div>
  );
}
