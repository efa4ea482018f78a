/**
 * Sensors: rate, longest gap and latency side by side, because a sensor at its full rate may still
 * pause for half a second.
 */
// SPDX-License-Identifier: Apache-2.0
import { TableHead } from "../../view/table_head";
import { Value } from "../../view/value";

const kSensors = [
  ["gnss0", "GNSS 0"],
  ["gnss1", "GNSS 1"],
  ["imu0", "IMU 0"],
  ["imu1", "IMU 1"],
  ["lidar", "LiDAR"],
  ["camera", "camera"],
  ["radar", "radar"],
] as const;

export function SensorPanel() {
  return (
    <table class="readings">
      <TableHead names={["sensor", "rate Hz", "gap ms", "latency ms"]} />
      <tbody>
        {kSensors.map(([sensor, label]) => (
          <tr key={sensor}>
            <th scope="row">{label}</th>
            <td>
              <Value path={`sensors.${sensor}_rate`} decimals={1} unit={false} />
            </td>
            <td>
              <Value path={`sensors.${sensor}_gap`} decimals={0} unit={false} />
            </td>
            <td>
              <Value path={`sensors.${sensor}_latency`} decimals={0} unit={false} />
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
