// Reads MCAP files with @mcap/core, twice each: as a stream and by the index, all CRCs checked.
// Both ways must give the same messages.
//   node check_mcap.mjs FILE...
//   out    a line for each file: messages, first and last log time, topics with a message
// SPDX-License-Identifier: Apache-2.0
import { readFile } from "node:fs/promises";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

function streamed(bytes) {
  const messages = [];
  const topics = new Map();
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(bytes);
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Channel") topics.set(record.id, record.topic);
    if (record.type !== "Message") continue;
    messages.push({ logTime: record.logTime, topic: topics.get(record.channelId) });
  }
  if (!reader.done()) throw new Error("the file does not end with a footer and magic");
  return messages;
}

async function indexed(bytes) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  let count = 0;
  let before = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    if (message.logTime < before) throw new Error("the index does not give the order of time");
    before = message.logTime;
    ++count;
  }
  if (BigInt(count) !== reader.statistics.messageCount) throw new Error("statistics");
  return count;
}

for (const file of process.argv.slice(2)) {
  const bytes = await readFile(file);
  const messages = streamed(bytes);
  const count = await indexed(bytes);
  if (count !== messages.length) throw new Error(`${file}: ${count} of ${messages.length}`);
  const times = messages.map((m) => m.logTime).sort((a, b) => (a < b ? -1 : a > b ? 1 : 0));
  const topics = [...new Set(messages.map((m) => m.topic))].sort();
  console.log(`${count} ${times[0] ?? "-"} ${times.at(-1) ?? "-"} ${topics.join(",") || "-"}`);
}
