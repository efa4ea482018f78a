/**
 * Many clients of one base's console at once, in a process of their own.
 *
 *   node crowd.mjs KIND COUNT ADDRESS [TOKEN]
 *
 * silent    connections that say nothing, opened again when they are closed
 * slow      connections that send a request byte by byte and never end it
 * refused   WebSockets without a token, each tried again when it is refused
 * viewers   consoles with a token that read everything, tried again when they are refused
 * marks     viewers that say marks as fast as they are heard
 *
 * Says `begun` when every one was tried once, then each second `open NUMBER`; ends with its input.
 */
// SPDX-License-Identifier: Apache-2.0
import { connect } from "node:net";
import { WebSocket } from "../../system/console/packages.mjs";

const [kind, count, address, token] = process.argv.slice(2);
const { hostname, port } = new URL(address);
const kAgainMs = 100;
const kDripMs = 1000;
const kMarkEachMs = 5;
const kMarkRoom = 64 * 1024;
const kRequest = `GET /api/catalogue HTTP/1.1\r\nHost: ${hostname}:${port}\r\nX: `;

let tried = 0;
let open = 0;

function told() {
  tried += 1;
  if (tried === Number(count)) console.log("begun");
}

/** Runs `start` now, and again whenever what it began has ended. */
function keep(start) {
  let first = true;
  const ended = () => {
    if (first) told();
    first = false;
    setTimeout(() => start(begun, ended), kAgainMs);
  };
  const begun = () => {
    if (first) told();
    first = false;
  };
  start(begun, ended);
}

function tcp(begun, ended) {
  let drip;
  const socket = connect(Number(port), hostname, () => {
    open += 1;
    begun();
    if (kind !== "slow") return;
    socket.write(kRequest);
    drip = setInterval(() => socket.write("x"), kDripMs);
  });
  socket.on("error", () => {});
  socket.on("close", (failed) => {
    clearInterval(drip);
    if (!failed || open > 0) open = Math.max(0, open - 1);
    ended();
  });
}

function console_(begun, ended) {
  const headers = token ? { Authorization: `Bearer ${token}` } : {};
  const socket = new WebSocket(`${address.replace("http", "ws")}/ws`, { headers });
  let came = false;
  let marks;
  socket.on("open", () => {
    came = true;
    open += 1;
    begun();
    if (kind !== "marks") return;
    const text = JSON.stringify({ type: "mark", text: "m".repeat(200) });
    marks = setInterval(() => {
      while (socket.bufferedAmount < kMarkRoom) socket.send(text);
    }, kMarkEachMs);
  });
  socket.on("error", () => {});
  socket.on("close", () => {
    clearInterval(marks);
    if (came) open -= 1;
    ended();
  });
}

for (let n = 0; n < Number(count); ++n) keep(kind === "silent" || kind === "slow" ? tcp : console_);
setInterval(() => console.log(`open ${open}`), 1000);
process.stdin.resume().on("end", () => process.exit(0));
