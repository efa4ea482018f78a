// Writes a bag of ROS 2 as an MCAP file with @mcap/core, as rosbag2 does: profile ros2, schemas in
// the chunks.
//   node write_bag.mjs FILE COMPRESSION CHUNK_BYTES COUNT    COMPRESSION: none, lz4, zstd
// SPDX-License-Identifier: Apache-2.0
import { writeFileSync } from "node:fs";
import { zstdCompressSync } from "node:zlib";
import lz4 from "lz4js";
import { McapWriter } from "@mcap/core";
import { kTexts, messages } from "./bag_messages.mjs";

const [file, compression, chunkBytes, count] = process.argv.slice(2);
const compress = { lz4: (b) => lz4.compress(b), zstd: (b) => zstdCompressSync(b) }[compression];
const parts = [];
let size = 0;
const writer = new McapWriter({
  writable: {
    position: () => BigInt(size),
    write: async (buffer) => {
      parts.push(Buffer.from(buffer));
      size += buffer.length;
    },
  },
  chunkSize: Number(chunkBytes),
  compressChunk: compress && ((bytes) => ({ compression, compressedData: compress(bytes) })),
});
await writer.start({ profile: "ros2", library: "oracle" });
const channels = new Map();
let sequence = 0;
for (const message of messages(Number(count))) {
  if (!channels.has(message.topic)) {
    const schemaId = await writer.registerSchema({
      name: message.type, encoding: "ros2msg",
      data: new TextEncoder().encode(kTexts[message.type] ?? "# of ROS 2 itself\n"),
    });
    const channel = { topic: message.topic, schemaId, messageEncoding: "cdr", metadata: new Map() };
    channels.set(message.topic, await writer.registerChannel(channel));
  }
  await writer.addMessage({
    channelId: channels.get(message.topic), sequence: sequence++, logTime: message.stamp,
    publishTime: message.stamp, data: message.bytes,
  });
}
await writer.end();
writeFileSync(file, Buffer.concat(parts));
