/**
 * Sensors: rate, longest gap and latency side by side, because a sensor at its full rate may still
 * pause for half a second. Drops are counted of those that see other cars; such a sensor has a row
 * when the car has it.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../../store/session";
import { kDigitsHz, usePainter } from "../../view/painting";
import { TableHead } from "../../view/table_head";
import { read } from "../../view/timeline";
import { Value } from "../../view/value";
import { Quality } from "../../wire/status";

/** On every car. */
const kLocalizationSensors = [
  ["gnss0", "GNSS 0"],
  ["gnss1", "GNSS 1"],
  ["imu0", "IMU 0"],
  ["imu1", "IMU 1"],
] as const;

/** LiDAR: frames of detections; LiDAR 0 to 2: clouds. */
const kDetectionSensors = [
  ["lidar", "LiDAR"],
  ["lidar0", "LiDAR 0"],
  ["lidar1", "LiDAR 1"],
  ["lidar2", "LiDAR 2"],
  ["camera0", "camera 0"],
  ["camera1", "camera 1"],
  ["radar", "radar"],
] as const;

interface RowProps {
  sensor: string;
  label: string;
}

function ArrivalCells({ sensor, label }: RowProps) {
  return (
    <>
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
    </>
  );
}

function DetectionSensorRow({ sensor, label }: RowProps) {
  const row = useRef<HTMLTableRowElement>(null);
  const slot = session.fields.value.slot(`sensors.${sensor}_rate`);
  usePainter(
    () => {
      const reading = read(slot);
      const isThere = reading.quality !== Quality.never && Number.isFinite(reading.value);
      if (row.current) row.current.hidden = !isThere;
    },
    kDigitsHz,
    [slot],
  );
  return (
    <tr ref={row} hidden>
      <ArrivalCells sensor={sensor} label={label} />
      <td>
        <Value path={`sensors.${sensor}_drops`} unit={false} />
      </td>
    </tr>
  );
}

export function SensorPanel() {
  return (
    <table class="readings">
      <TableHead names={["sensor", "rate Hz", "gap ms", "latency ms", "drops"]} />
      <tbody>
        {kLocalizationSensors.map(([sensor, label]) => (
          <tr key={sensor}>
            <ArrivalCells sensor={sensor} label={label} />
            <td />
          </tr>
        ))}
        {kDetectionSensors.map(([sensor, label]) => (
          <DetectionSensorRow key={sensor} sensor={sensor} label={label} />
        ))}
      </tbody>
    </table>
  );
}
