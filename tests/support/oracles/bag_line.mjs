// One message of a recording as a line: topic, stamp, then what it carries. CAN frames of any
// encoding are written alike, so that two formats can be compared; all else as its bytes.
// SPDX-License-Identifier: Apache-2.0
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

const kCan = [
  "can_msgs/msg/Frame",
  "ros2_socketcan_msgs/msg/FdFrame",
  "pitwall_msgs/msg/CarCanFrame",
];
const readers = new Map();

function decoded(type, text, bytes) {
  if (!readers.has(type)) readers.set(type, new MessageReader(parse(text, { ros2: true })));
  return readers.get(type).readMessage(bytes);
}

// Nothing where it is a report of an error.
export function bagLine(topic, stamp, type, text, bytes) {
  const head = `${topic} ${stamp} `;
  if (!kCan.includes(type)) return head + Buffer.from(bytes).toString("hex");
  const frame = decoded(type, text, bytes);
  if (frame.is_error) return undefined;
  const isFd = frame.fd ?? type.endsWith("FdFrame");
  const isRemote = frame.remote ?? frame.is_rtr ?? false;
  const length = frame.dlc ?? frame.len ?? frame.data.length;
  const data = isRemote ? "" : Buffer.from(frame.data.slice(0, length)).toString("hex");
  const flags = [frame.extended ?? frame.is_extended, isRemote, isFd].map(Number).join("");
  return `${head}can ${frame.id.toString(16)} ${flags} ${length} ${data}`;
}
