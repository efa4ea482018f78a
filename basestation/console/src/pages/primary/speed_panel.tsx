/**
 * Speed, what was asked of the car and what it does: actual filled, asked hollow, race control's
 * round as a tick.
 */
// SPDX-License-Identifier: Apache-2.0
import { Bar } from "../../view/bar";
import { lapText } from "../../view/format";
import { lineText, reasonText } from "./limit_words";
import { kGaugesHz } from "../../view/painting";
import { Line, Tile, Value } from "../../view/value";

const kTopSpeedMps = 85;
const kTopRpm = 7500;
const kMostBrakeKpa = 6000;
const kMostSteeringRad = 0.3;

/** The borders of the cross-track alarm, as ticks. */
const kOffTrack = [-2, -1.25, 1.25, 2].map((at) => ({ at, label: `${at} m` }));

export function SpeedPanel() {
  return (
    <div class="speed-body">
      <div class="speed-head">
        <Value path="ego.vx" decimals={0} hz={kGaugesHz} class="huge" />
        <Tile label="target" path="track.target_speed" decimals={0} unit={false} />
        <Tile label="gear" path="feedback.gear" big />
      </div>
      <Bar
        path="ego.vx"
        label="speed"
        max={kTopSpeedMps}
        asked="track.target_speed"
        ticks={[
          { path: "flags.round_target_speed", label: "round speed of race control" },
          { path: "planner.operator_limit", label: "limit of the operator" },
        ]}
      />
      <div class="limit">
        <Line label="limited by" path="planner.reason" text={reasonText} />
        <Line label="line" path="planner.line" text={lineText} unit={false} />
        <Line label="from the line" path="planner.line_offset" decimals={1} />
      </div>
      <div class="gauges">
        <Line label="rpm" path="engine.speed" unit={false} />
        <Bar path="engine.speed" label="engine speed" max={kTopRpm} />
        <Line label="throttle" path="feedback.throttle" scale={100} decimals={0} unit="%" />
        <Bar path="feedback.throttle" label="throttle" max={1} asked="command.throttle" />
        <Line label="brake" path="feedback.brake_front" decimals={0} />
        <Bar path="feedback.brake_front" label="brake" max={kMostBrakeKpa} asked="command.brake" />
        <Line label="steer" path="feedback.steering" decimals={1} />
        <Bar
          path="feedback.steering"
          label="steering"
          min={-kMostSteeringRad}
          max={kMostSteeringRad}
          asked="command.steering"
          centred
        />
        <Line label="CTE" path="dynamics.lateral_error" />
        <Bar
          path="dynamics.lateral_error"
          label="cross-track error"
          min={-2.5}
          max={2.5}
          ticks={kOffTrack}
          centred
        />
      </div>
      <div class="tiles four">
        <Tile label="long. acc." path="dynamics.forward" decimals={1} />
        <Tile label="lat. acc." path="dynamics.left" decimals={1} />
        <Tile label="lap" path="track.lap" />
        <Tile label="last lap" path="track.last_lap_time" text={lapText} unit={false} />
      </div>
    </div>
  );
}
