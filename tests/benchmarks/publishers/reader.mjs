/**
 * A Foxglove client that subscribes to every channel, as a process that can be stopped:
 * node reader.mjs ADDRESS. Says "open" when it is in, and at each line of its input how many
 * messages it has had and what the server said that it lost: "had N, told M times of losses".
 */
// SPDX-License-Identifier: Apache-2.0
import { createInterface } from "node:readline";
import { WebSocket } from "../../system/console/packages.mjs";

const socket = new WebSocket(process.argv[2], ["foxglove.sdk.v1"]);
let had = 0;
let losses = 0;
socket.on("message", (data, isBinary) => {
  if (isBinary) {
    if (data[0] === 1) ++had;
    return;
  }
  const text = JSON.parse(String(data));
  if (text.op === "status") ++losses;
  if (text.op !== "advertise") return;
  const subscriptions = text.channels.map(({ id }) => ({ id, channelId: id }));
  socket.send(JSON.stringify({ op: "subscribe", subscriptions }));
  console.log("open");
});
createInterface({ input: process.stdin }).on("line", () =>
  console.log(`had ${had}, told ${losses} times of losses`),
);
