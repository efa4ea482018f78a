// Reads an MCAP file with @mcap/core, front to back and by its indexes, checks every CRC, and
// prints one line per message. CDR messages are decoded by @foxglove's ROS 2 reader.
//   node read_mcap.mjs FILE
// SPDX-License-Identifier: Apache-2.0
import { readFile } from "node:fs/promises";
import { crc32 } from "@foxglove/crc";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { line } from "./mcap_line.mjs";

const file = process.argv[2];
const bytes = await readFile(file);
const decoder = new TextDecoder();

function readerOf(schema) {
  if (schema?.encoding !== "ros2msg") return undefined;
  return new MessageReader(parse(decoder.decode(schema.data), { ros2: true }));
}

function printStream() {
  console.log("stream");
  const schemas = new Map();
  const channels = new Map();
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(bytes);
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Message") {
      const channel = channels.get(record.channelId);
      console.log(line(channel, record, readerOf(schemas.get(channel.schemaId))));
    }
    if (record.type === "DataEnd") checkDataCrc(record.dataSectionCrc);
  }
  if (!reader.done()) throw new Error("the file does not end with a footer and magic");
}

// DataEnd is 13 bytes long and followed by the summary, where the footer says.
function checkDataCrc(stored) {
  const summaryStart = Number(bytes.readBigUInt64LE(bytes.length - 8 - 20));
  if (stored === 0 || stored !== crc32(bytes.subarray(0, summaryStart - 13)))
    throw new Error("data section CRC");
}

async function printIndexed() {
  console.log("indexed");
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    console.log(line(channel, message, readerOf(reader.schemasById.get(channel.schemaId))));
  }
  const s = reader.statistics;
  console.log(
    `statistics ${s.messageCount} ${s.schemaCount} ${s.channelCount} ${s.chunkCount} ` +
      `${s.metadataCount} ${s.messageStartTime} ${s.messageEndTime}`,
  );
  for await (const record of reader.readMetadata({ name: "run" }))
    console.log(`run ${[...record.metadata].map(([k, v]) => `${k}=${v}`).join(" ")}`);
  if (reader.chunkIndexes.length !== s.chunkCount) throw new Error("chunk indexes");
}

printStream();
await printIndexed();
