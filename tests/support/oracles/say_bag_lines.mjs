// Lines of read_db3.py as lines of bag_line.mjs: what @foxglove/rosmsg2-serialization makes of the
// CAN frames.
//   python3 read_db3.py FILE | node say_bag_lines.mjs
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { bagLine } from "./bag_line.mjs";
import { kTexts } from "./bag_messages.mjs";

const lines = readFileSync(0, "utf8").split("\n").filter(Boolean).map((line) => {
  const [topic, type, stamp, digits] = line.split(" ");
  return bagLine(topic, stamp, type, kTexts[type], Buffer.from(digits, "hex"));
});
const said = lines.filter((line) => line !== undefined);
process.stdout.write(said.map((line) => line + "\n").join(""));
