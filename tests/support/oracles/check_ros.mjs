// Lines {type, text, bytes, said}: the text must be the message of ROS 2 Jazzy, and the bytes must
// say under that text what `said` says. A message of pitwall_msgs is ours alone: only what it
// refers to is compared with ROS 2.
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { isDeepStrictEqual } from "node:util";
import { parse } from "@foxglove/rosmsg";
import { ros2jazzy } from "@foxglove/rosmsg-msgs-common";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

const shortName = (name) => name.replace("/msg/", "/");
const times = { time: "builtin_interfaces/Time", duration: "builtin_interfaces/Duration" };
// The library has these two as numbers of their own, and `byte` as uint8.
const typeName = (type) => times[type] ?? (type === "byte" ? "uint8" : shortName(type));

const outline = (fields) =>
  fields
    .filter((field) => !field.isConstant)
    .map((f) => `${typeName(f.type)}${f.isArray ? `[${f.arrayLength ?? ""}]` : ""} ${f.name}`);
const constants = (fields) =>
  fields.filter((f) => f.isConstant && f.name !== "MODIFY").map((f) => `${f.name}=${f.value}`);

// Time is {sec, nsec} there.
function plain(value) {
  if (Number.isNaN(value)) return "NaN";
  if (ArrayBuffer.isView(value)) return Array.from(value, plain);
  if (Array.isArray(value)) return value.map(plain);
  if (typeof value === "bigint") return Number(value);
  if (typeof value !== "object") return value;
  const entries = Object.entries(value).map(([k, v]) => [k === "nsec" ? "nanosec" : k, plain(v)]);
  return Object.fromEntries(entries);
}

let messages = 0;
for (const line of readFileSync(process.argv[2], "utf8").trim().split("\n")) {
  const { type, text, bytes, said } = JSON.parse(line);
  const fail = (why, got, wanted) => {
    console.log(`${type}: ${why}\n${JSON.stringify(got)}\n${JSON.stringify(wanted)}`);
    process.exit(1);
  };
  const definitions = parse(text, { ros2: true });
  for (const definition of definitions) {
    const name = shortName(definition.name ?? type);
    if (name.startsWith("pitwall_msgs/")) continue;
    const wanted = ros2jazzy[name]?.definitions;
    if (!wanted) fail(`ROS 2 Jazzy has no ${name}`);
    for (const part of [outline, constants])
      if (!isDeepStrictEqual(part(definition.definitions), part(wanted)))
        fail(`${name} is another message`, part(definition.definitions), part(wanted));
  }
  const decoded = plain(new MessageReader(definitions).readMessage(Buffer.from(bytes, "hex")));
  if (!isDeepStrictEqual(decoded, said)) fail("says something else", decoded, said);
  ++messages;
}
console.log(`${messages} messages agree`);
