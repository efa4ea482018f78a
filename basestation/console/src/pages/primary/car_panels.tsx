/**
 * The car's computer and its powertrain, as a few numbers each.
 */
// SPDX-License-Identifier: Apache-2.0
import { Line } from "../../view/value";

export function ComputerPanel() {
  return (
    <div class="lines">
      <Line label="busiest core" path="computer.processor" scale={100} decimals={0} unit="%" />
      <Line label="memory" path="computer.memory" decimals={0} />
      <Line label="temperature" path="computer.temperature" decimals={0} />
      <Line label="step p50" path="computer.step_time_p50" decimals={0} />
      <Line label="step max" path="computer.step_time_max" decimals={0} />
      <Line label="missed" path="computer.missed_deadlines" />
    </div>
  );
}

export function PowertrainPanel() {
  return (
    <div class="lines">
      <Line label="coolant" path="engine.coolant" decimals={0} />
      <Line label="oil" path="powertrain.oil" decimals={0} />
      <Line label="oil pressure" path="engine.oil_pressure" decimals={0} />
      <Line label="fuel pressure" path="engine.fuel_pressure" decimals={0} />
      <Line label="gearbox" path="powertrain.transmission" decimals={0} />
      <Line label="battery" path="electric.battery" decimals={1} />
    </div>
  );
}
