// Writes an MCAP file with @mcap/core and prints one line per message.
//   node write_mcap.mjs FILE CHUNK-BYTES   (0: no chunks)
// SPDX-License-Identifier: Apache-2.0
import { writeFile } from "node:fs/promises";
import { McapWriter } from "@mcap/core";
import { line } from "./mcap_line.mjs";

const [file, chunkBytes] = [process.argv[2], Number(process.argv[3])];
const parts = [];
let size = 0;
const writable = {
  position: () => BigInt(size),
  write: async (buffer) => {
    parts.push(Buffer.from(buffer));
    size += buffer.length;
  },
};

const writer = new McapWriter({ writable, useChunks: chunkBytes > 0, chunkSize: chunkBytes });
await writer.start({ profile: "", library: "oracle" });
await writer.addMetadata({ name: "run", metadata: new Map([["seed", "7"]]) });
const schemaId = await writer.registerSchema({
  name: "Any", encoding: "jsonschema", data: new TextEncoder().encode("{}"),
});
const channels = [];
for (const topic of ["/a", "/b", "/c"]) {
  const channel = { topic, schemaId, messageEncoding: "json", metadata: new Map([["k", topic]]) };
  channels.push({ ...channel, id: await writer.registerChannel(channel) });
}
for (let i = 0; i < 500; ++i) {
  const channel = channels[(i * i) % 3];
  const message = {
    channelId: channel.id,
    sequence: i,
    logTime: BigInt(i) * 10_000_000n,
    publishTime: BigInt(i) * 10_000_000n + 3n,
    data: new Uint8Array(i % 97).map((_, k) => (i * 31 + k * 7) & 0xff),
  };
  await writer.addMessage(message);
  console.log(line(channel, message, undefined));
}
await writer.addAttachment({
  name: "x", logTime: 1n, createTime: 2n, mediaType: "text/plain", data: new Uint8Array(5),
});
await writer.end();
await writeFile(file, Buffer.concat(parts));
