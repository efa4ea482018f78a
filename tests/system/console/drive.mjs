/**
 * A scripted drive for the test double: an oval, a car that laps it, and what its fields are at a
 * time. Plausible enough to judge the looks by; the truth of the numbers is tested elsewhere.
 */
// SPDX-License-Identifier: Apache-2.0

const kStraightM = 600;
const kRadiusM = 220;
const kTurnM = Math.PI * kRadiusM;
export const kLengthM = 2 * kStraightM + 2 * kTurnM;
const kLeftM = 5;
const kRightM = 11;

/** The centre line at station s: place and direction, driven anticlockwise. */
export function centreAt(s) {
  const at = ((s % kLengthM) + kLengthM) % kLengthM;
  const half = kStraightM / 2;
  if (at < kStraightM) return { x: at - half, y: -kRadiusM, yaw: 0 };
  if (at < kStraightM + kTurnM) {
    const a = (at - kStraightM) / kRadiusM;
    return {
      x: half + kRadiusM * Math.sin(a),
      y: -kRadiusM * Math.cos(a),
      yaw: a,
    };
  }
  if (at < 2 * kStraightM + kTurnM) {
    return { x: half - (at - kStraightM - kTurnM), y: kRadiusM, yaw: Math.PI };
  }
  const a = (at - 2 * kStraightM - kTurnM) / kRadiusM;
  return {
    x: -half - kRadiusM * Math.sin(a),
    y: kRadiusM * Math.cos(a),
    yaw: Math.PI + a,
  };
}

export function placeAt(s, offset) {
  const { x, y, yaw } = centreAt(s);
  return { x: x - offset * Math.sin(yaw), y: y + offset * Math.cos(yaw), yaw };
}

const ring = (offset) => {
  const points = [];
  for (let s = 0; s < kLengthM; s += 5) {
    const { x, y } = placeAt(s, offset);
    points.push([x, y]);
  }
  return points;
};

export const kTrack = {
  name: "Test oval",
  length_m: kLengthM,
  datum: { latitude_deg: 36.2722, longitude_deg: -115.0103 },
  centre: ring(0).map(([x, y], i) => [x, y, 5 * i]),
  left: ring(kLeftM),
  right: ring(-kRightM),
  lines: [],
  pit: ring(24).filter((_, i) => i < (kStraightM - 40) / 5),
  corners: [
    { name: "T1-2", from_s: kStraightM, to_s: kStraightM + kTurnM },
    { name: "T3-4", from_s: 2 * kStraightM + kTurnM, to_s: kLengthM },
  ],
  sectors: [0, kLengthM / 3, (2 * kLengthM) / 3],
};

const wheels = (group, values) =>
  Object.fromEntries(
    ["front_left", "front_right", "rear_left", "rear_right"].map((wheel, i) => [
      `${group}${wheel}`,
      values[i],
    ]),
  );

function motion(t, speed) {
  const station = (speed * t) % kLengthM;
  const offset = 2 + 0.4 * Math.sin(t / 3);
  const pose = placeAt(station, offset);
  const turning = Math.abs(Math.sin(pose.yaw)) > 1e-9;
  const swing = Math.sin(t * 1.7);
  return {
    "ego.x": pose.x,
    "ego.y": pose.y,
    "ego.yaw": Math.atan2(Math.sin(pose.yaw), Math.cos(pose.yaw)),
    "ego.vx": speed + 0.4 * swing,
    "ego.vy": 0.05 * swing,
    "ego.validity": 1,
    "ego.yaw_rate": turning ? speed / kRadiusM : 0,
    "ego.position_sigma": 0.012,
    "track.station": station,
    "track.offset": offset,
    "track.target_speed": speed + 1,
    "track.lap": Math.floor((speed * t) / kLengthM) + 3,
    "track.last_lap_time": 38.42,
    "command.steering": turning ? 0.014 : 0.001 * swing,
    "command.throttle": 0.62 + 0.05 * swing,
    "command.brake": 0,
    "command.gear": 6,
    "command.actuate": 1,
    "command.limited": 0,
    "feedback.steering": (turning ? 0.0135 : 0.001 * swing) + 0.0004 * Math.sin(t * 9),
    "feedback.throttle": 0.6 + 0.05 * Math.sin(t * 1.7 - 0.2),
    "feedback.gear": 6,
    "feedback.brake_front": 0,
    "feedback.brake_rear": 0,
    "dynamics.forward": 0.3 * swing,
    "dynamics.left": turning ? 21.2 : 0.2 * swing,
    "dynamics.up": 9.8,
    "dynamics.lateral_error": 0.14 * Math.sin(t * 0.9),
    "dynamics.speed_error": 0.4 * swing,
    ...wheels("wheels.", [speed, speed + 0.1, speed + 0.3, speed + 0.4]),
  };
}

/** The third is not seen for some of the time, and its place becomes unsure. */
function rivals(t, speed) {
  const values = {};
  const unseenS = Math.max(0.1, (t % 6) - 2);
  [
    [12, 78, 4.5, 0.05],
    [31, -46, 1.0, 0.05],
    [45, 140, -1.5, unseenS],
  ].forEach(([identity, gap, offset, age], i) => {
    const group = `opponent_${i + 1}.`;
    values[`${group}identity`] = identity;
    values[`${group}station`] = (speed * t + gap + 6 * Math.sin(t / 5) + kLengthM) % kLengthM;
    values[`${group}offset`] = offset;
    values[`${group}speed`] = speed + 1.2 * Math.cos(t / 5);
    values[`${group}age`] = age;
    values[`${group}position_sigma`] = 0.3 + 1.5 * age;
  });
  return values;
}

function body(t) {
  const sensors = {};
  const nominal = {
    gnss0: 20,
    gnss1: 20,
    imu0: 125,
    imu1: 125,
    lidar: 20,
    lidar0: 20,
    lidar1: 20,
    lidar2: 20,
    camera0: 10,
    radar: 14,
  };
  for (const [name, rate] of Object.entries(nominal)) {
    sensors[`sensors.${name}_rate`] = rate;
    sensors[`sensors.${name}_gap`] = Math.round(1100 / rate);
    sensors[`sensors.${name}_latency`] = name === "lidar" ? 92 : 8;
    if (!/^(gnss|imu)/.test(name)) sensors[`sensors.${name}_drops`] = name === "lidar1" ? 12 : 0;
  }
  return {
    ...sensors,
    ...wheels("tyres.temperature_", [74 + Math.sin(t / 20), 88, 79, 92]),
    ...wheels("tyres.pressure_", [152, 176, 149, 171]),
    ...wheels("tread.inner_", [78, 92, 81, 95]),
    ...wheels("tread.outer_", [70, 84, 76, 88]),
    "engine.speed": 5900 + 60 * Math.sin(t),
    "engine.running": 1,
    "engine.fuel_pressure": 412,
    "engine.oil_pressure": 545,
    "engine.coolant": 88,
    "powertrain.oil": 104,
    "powertrain.transmission": 91,
    "powertrain.torque": 310,
    "electric.battery": 13.8,
    "fuel.level": 31.4 - t / 500,
    "fuel.used": 12 + t / 500,
    "fuel.flow": 41,
    "fuel.laps_left": 11.6,
    "computer.processor": 0.61,
    "computer.memory": 3120,
    "computer.temperature": 68,
    "computer.step_time_p50": 310,
    "computer.step_time_max": 1420,
    "computer.missed_deadlines": 0,
    "localization.sigma_x": 0.012,
    "localization.sigma_y": 0.011,
    "localization.height": 601.2,
  };
}

function receivers() {
  const values = {};
  for (const unit of ["gnss0", "gnss1"]) {
    Object.assign(values, {
      [`${unit}.status`]: 0,
      [`${unit}.type`]: 50,
      [`${unit}.satellites`]: unit === "gnss0" ? 19 : 17,
      [`${unit}.sigma`]: 0.012,
      [`${unit}.heading_sigma`]: 0.0014,
      [`${unit}.differential_age`]: 1,
      [`${unit}.position_verdict`]: 1,
      [`${unit}.speed`]: 66,
    });
  }
  return values;
}

/** Every field with a value at `t` seconds of the drive; what is missing was never heard. */
export function valuesAt(t, streams) {
  const speed = 62;
  return {
    "mode.mode": 2,
    "mode.ct_state": 9,
    "mode.sys_state": 8,
    "mode.first_stop_cause": 0,
    "mode.arming": 1,
    "mode.stop_latch": 0,
    "mode.stop_challenge": 17,
    "mode.quiet": 0,
    "flags.track": 4,
    "flags.vehicle": 10,
    "flags.round_target_speed": 62.6,
    "flags.heartbeat_age": 0.05,
    "flags.track_acted_on": 4,
    "flags.vehicle_acted_on": 10,
    "flags.conflict": 0,
    "planner.role": 2,
    "planner.primitive": 1,
    "planner.operator_limit": 65,
    "planner.line_offset": 2,
    ...motion(t, speed),
    ...rivals(t, speed),
    ...body(t),
    ...receivers(),
    ...Object.fromEntries(streams.map((path) => [path, 2])),
    "radio.base": 2,
    "radio.rung": 0,
    "radio.silence": 0.04,
    "radio.round_trip": 31,
    "link.state": 1,
    "link.silence_ms": 20,
    "link.down_loss": 0.012,
    "link.up_loss": 0.004,
    "link.rtt_ms": 31 + 4 * Math.sin(t),
    "link.jitter_ms": 3.2,
    "link.down_kbit_s": 52.4,
    "link.down_cap_kbit_s": 56,
    "link.up_kbit_s": 6.1,
    "link.worst_age_ms": 84,
    "link.stale_groups": 0,
    "derived.tyre_min": 74,
    "derived.tyre_gate": 79,
    "derived.slip": 0.006,
    "derived.fuel_per_lap": 2.1,
    "derived.fuel_laps": 14.9,
    "derived.fuel_level": 31.4,
    "derived.fuel_least": 29.8,
    "derived.fuel_least_laps": 11.6,
    "derived.fuel_attempts": 5,
  };
}
