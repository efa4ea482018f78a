/**
 * Every stream that the car watches, one cell each: a grey dot while it is heard, a filled shape
 * and its word when it is late or lost.
 */
// SPDX-License-Identifier: Apache-2.0
import { Value } from "../../view/value";

const kCells: readonly (readonly [string, string])[] = [
  ["gnss0_link", "GNSS 0"],
  ["gnss1_link", "GNSS 1"],
  ["gnss0_position", "0 pos"],
  ["gnss1_position", "1 pos"],
  ["gnss0_solution", "0 fix"],
  ["gnss1_solution", "1 fix"],
  ["gnss0_velocity", "0 vel"],
  ["gnss1_velocity", "1 vel"],
  ["gnss0_heading", "0 head"],
  ["gnss1_heading", "1 head"],
  ["imu0", "IMU 0"],
  ["imu1", "IMU 1"],
  ["wheel_speed", "wheels"],
  ["steering", "steering"],
  ["brake", "brake"],
  ["throttle", "throttle"],
  ["powertrain", "power"],
  ["diagnostics", "diagn."],
  ["misc", "misc"],
  ["race_control", "race ctl"],
  ["planner", "planner"],
  ["radio", "radio"],
];

export function WatchdogPanel() {
  return (
    <div class="watchdogs">
      {kCells.map(([stream, label]) => (
        <div class="cell" key={stream} role="group" aria-label={`watchdog ${label}`}>
          <span class="label">{label}</span>
          <Value path={`streams.${stream}`} class="state" />
        </div>
      ))}
    </div>
  );
}
