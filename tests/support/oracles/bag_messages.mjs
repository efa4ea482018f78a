// The messages of a bag as a team has them, the same every time: CAN, GNSS, IMU, odometry, point
// clouds and a type that nobody knows.
//   node bag_messages.mjs COUNT [zstd]    zstd: each message compressed, as rosbag2 may do
//   out    a line for each: topic, type, stamp, its CDR as hexadecimal digits
// SPDX-License-Identifier: Apache-2.0
import { zstdCompressSync } from "node:zlib";
import { parse } from "@foxglove/rosmsg";
import { ros2jazzy } from "@foxglove/rosmsg-msgs-common";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";

const kHeader = `std_msgs/Header header
`;
const kLine = "=".repeat(80);
const kHeaderTypes = `${kLine}
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
${kLine}
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
`;
export const kTexts = {
  "can_msgs/msg/Frame":
    kHeader +
    "uint32 id\nbool is_rtr\nbool is_extended\nbool is_error\nuint8 dlc\nuint8[8] data\n" +
    kHeaderTypes,
  "ros2_socketcan_msgs/msg/FdFrame":
    kHeader +
    "uint32 id\nbool is_extended\nbool is_error\nuint8 len\nuint8[<=64] data\n" +
    kHeaderTypes,
  "team_msgs/msg/TyreSet": "string compound\nfloat32[4] pressure_kpa\n",
};

// The types of ROS 2 itself come from the library.
function definitionsOf(type) {
  if (kTexts[type]) return parse(kTexts[type], { ros2: true });
  const seen = new Map();
  const visit = (name) => {
    if (seen.has(name)) return;
    seen.set(name, { name, ...ros2jazzy[name] });
    for (const field of ros2jazzy[name].definitions) if (field.isComplex) visit(field.type);
  };
  visit(type.replace("/msg/", "/"));
  return [...seen.values()];
}
const writers = new Map();
export function encoded(type, message) {
  if (!writers.has(type)) writers.set(type, new MessageWriter(definitionsOf(type)));
  return writers.get(type).writeMessage(message);
}

const kStart = 1_700_000_000_000_000_000n;
const header = (stamp, frame_id) => ({
  stamp: { sec: Number(stamp / 1_000_000_000n), nsec: Number(stamp % 1_000_000_000n) },
  frame_id,
});
const bytes = (count, seed) =>
  Uint8Array.from({ length: count }, (_, k) => (seed * 31 + k * 7) & 255);

const kinds = [
  (i, stamp) => [
    "/can0", "can_msgs/msg/Frame",
    { header: header(stamp, "can0"), id: i % 4 === 3 ? 0x18daf110 + i : i % 0x7ff,
      is_rtr: i % 11 === 5, is_extended: i % 4 === 3, is_error: i % 17 === 9, dlc: i % 9,
      data: bytes(8, i) },
  ],
  (i, stamp) => [
    "/can1/fd", "ros2_socketcan_msgs/msg/FdFrame",
    { header: header(stamp, "can1"), id: i % 0x7ff, is_extended: false, is_error: false,
      len: [0, 7, 12, 64][i % 4], data: bytes([0, 7, 12, 64][i % 4], i) },
  ],
  (i, stamp) => [
    "/gnss/fix", "sensor_msgs/msg/NavSatFix",
    { header: header(stamp, "gnss"), status: { status: 2, service: 1 }, latitude: 36.27 + i * 1e-6,
      longitude: -115.01, altitude: 594.25, position_covariance: new Float64Array(9).fill(i),
      position_covariance_type: 2 },
  ],
  (i, stamp) => [
    "/imu", "sensor_msgs/msg/Imu",
    { header: header(stamp, "imu_link"), orientation: { x: 0, y: 0, z: 0, w: 1 },
      orientation_covariance: new Float64Array(9), angular_velocity: { x: i, y: 0.1, z: -0.2 },
      angular_velocity_covariance: new Float64Array(9),
      linear_acceleration: { x: 0, y: 0, z: 9.81 },
      linear_acceleration_covariance: new Float64Array(9) },
  ],
  (i, stamp) => [
    "/odom", "nav_msgs/msg/Odometry",
    { header: header(stamp, "odom"), child_frame_id: "base_link",
      pose: { pose: { position: { x: i, y: 2, z: 3 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
              covariance: new Float64Array(36) },
      twist: { twist: { linear: { x: 60, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.1 } },
               covariance: new Float64Array(36) } },
  ],
  (i, stamp) => [
    "/lidar/points", "sensor_msgs/msg/PointCloud2",
    { header: header(stamp, "lidar"), height: 1, width: 8,
      fields: ["x", "y", "z"].map((name, k) => ({ name, offset: 4 * k, datatype: 7, count: 1 })),
      is_bigendian: false, point_step: 12, row_step: 96, data: bytes(96, i), is_dense: true },
  ],
  (i) => ["/tyres", "team_msgs/msg/TyreSet", { compound: "soft", pressure_kpa: [i, 1, 2, 3] }],
];

// Stamps repeat, and every tenth is late.
export function* messages(count) {
  for (let i = 0; i < count; ++i) {
    const stamp = kStart + BigInt(i >> 1) * 1_000_000n - (i % 10 === 9 ? 2_500_000n : 0n);
    const [topic, type, message] = kinds[(i * i + (i >> 3)) % kinds.length](i, stamp);
    yield { topic, type, stamp, bytes: encoded(type, message) };
  }
}

if (process.argv[1].endsWith("bag_messages.mjs")) {
  const pack = process.argv[3] === "zstd" ? zstdCompressSync : (bytes) => bytes;
  const lines = [...messages(Number(process.argv[2]))].map(
    (m) => `${m.topic} ${m.type} ${m.stamp} ${Buffer.from(pack(m.bytes)).toString("hex")}\n`);
  process.stdout.write(lines.join(""));
}
