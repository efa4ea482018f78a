// Reads an MCAP file with @mcap/core, decompressing with others' LZ4 and Zstandard, all CRCs
// checked.
//   node read_bag.mjs FILE
//   out    a line for each message (bag_line.mjs), in the order of the file
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { zstdDecompressSync } from "node:zlib";
import lz4 from "lz4js";
import { McapStreamReader } from "@mcap/core";
import { bagLine } from "./bag_line.mjs";

const reader = new McapStreamReader({
  validateCrcs: true,
  decompressHandlers: {
    lz4: (bytes, size) => lz4.decompress(bytes, Number(size)),
    zstd: (bytes) => zstdDecompressSync(bytes),
  },
});
reader.append(readFileSync(process.argv[2]));
const schemas = new Map();
const channels = new Map();
const lines = [];
for (let record; (record = reader.nextRecord()); ) {
  if (record.type === "Schema") schemas.set(record.id, record);
  if (record.type === "Channel") channels.set(record.id, record);
  if (record.type !== "Message") continue;
  const channel = channels.get(record.channelId);
  const schema = schemas.get(channel.schemaId);
  const text = schema && new TextDecoder().decode(schema.data);
  const type = channel.messageEncoding === "cdr" ? schema.name : "";
  const line = bagLine(channel.topic, record.logTime, type, text, record.data);
  if (line !== undefined) lines.push(line);
}
if (!reader.done()) throw new Error("the file does not end with a footer and magic");
process.stdout.write(lines.map((line) => line + "\n").join(""));
