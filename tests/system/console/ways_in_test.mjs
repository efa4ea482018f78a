/**
 * Every way into the car, and no other: the sockets that a base with everything has open, the
 * options that may open one, and the places of the source that a command comes by. By each way the
 * same command is refused with the same words, leaves its line in the audit log, and never reaches
 * the car; what is no way at all changes nothing.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createSocket } from "node:dgram";
import { readdirSync, readFileSync, readlinkSync, writeFileSync } from "node:fs";
import { connect, createServer } from "node:net";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import { Client, eventually } from "./client.mjs";
import { kRoot, WebSocket } from "./packages.mjs";
import { kBase, Programs } from "./programs.mjs";

/** A command that a gate refuses while the car drives, and how each way says it. */
const kCommand = "command speed_limit 90";
const kStaged = { type: "stage", name: "speed limit", argument: 90 };
const kRefusal = /^gates: tyres: .+/;

/** What each option opens; everything else opens nothing that anybody else can write to. */
const kOpens = {
  "--listen": "radio",
  "--web": "console",
  "--foxglove": "Foxglove",
  "--stop-port": "stop port",
  "--command-socket": "command socket",
  "--command": "script",
  "--joystick": "joystick",
  "--ros": "DDS",
  "--lcm": "LCM",
  "--cars": "the same for several cars",
};
const kOpensNothing = [
  ...["--help", "--keys", "--key-log", "--stamp-file", "--network", "--signed", "--budget"],
  ...["--text", "--all", "--plain", "--duration", "--refresh", "--clock", "--json"],
  ...["--web-address", "--console-dir", "--track", "--web-tokens", "--default-role", "--web-name"],
  ...["--web-certificate", "--web-key", "--layouts", "--judgement", "--bench", "--car"],
  ...["--car-name", "--foxglove-address", "--foxglove-tokens", "--foxglove-origin"],
  ...["--ros-domain", "--ros-distro", "--ros-interface", "--ros-peer", "--record", "--replay"],
  ...["--recordings", "--joystick-axes"],
];

/** A port of this machine that nothing has. */
async function freePort() {
  const server = createServer();
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const { port } = server.address();
  await new Promise((done) => server.close(done));
  return port;
}

const programs = new Programs();
let address;
let foxglove;
let stopPort;
const commandSocket = join(programs.folder, "commands");

before(async () => {
  stopPort = await freePort();
  foxglove = await freePort();
  const joystick = join(programs.folder, "joystick");
  execFileSync("mkfifo", [joystick]);
  const script = join(programs.folder, "script");
  writeFileSync(script, `0.2 take 1\n0.3 ${kCommand}\n0.4 drop\n`);
  const flags = ["--foxglove", String(foxglove), "--stop-port", String(stopPort)];
  flags.push("--command-socket", commandSocket, "--command", script, "--joystick", joystick);
  flags.push("--ros", "--lcm", "", "--record", join(programs.folder, "record"));
  address = await programs.startBase(...flags);
  programs.startCar(300);
  await eventually("the script's turn", () => programs.baseSaid.includes("refused: gate"));
});
after(() => programs.close());

/** Receiving sockets of the base: "tcp 127.0.0.1:8080", "udp ...", "unix PATH". */
function socketsOf({ pid }) {
  const inodes = new Set(
    readdirSync(`/proc/${pid}/fd`).flatMap((fd) => {
      try {
        return readlinkSync(`/proc/${pid}/fd/${fd}`).match(/^socket:\[(\d+)\]$/)?.[1] ?? [];
      } catch {
        return [];
      }
    }),
  );
  const lines = (table) => readFileSync(`/proc/${pid}/net/${table}`, "utf8").trim().split("\n");
  const kListening = "0A";
  const found = [];
  for (const table of ["tcp", "tcp6", "udp", "udp6"]) {
    for (const line of lines(table).slice(1)) {
      const [, local, remote, state, , , , , , inode] = line.trim().split(/\s+/);
      if (!inodes.delete(inode)) continue;
      if (table.startsWith("tcp") && state !== kListening) continue;
      const [host, port] = local.split(":");
      const peer = Number.parseInt(remote.split(":")[1], 16);
      found.push({ table, host, port: Number.parseInt(port, 16), peer });
    }
  }
  for (const line of lines("unix").slice(1)) {
    const [, , , , , , inode, path] = line.trim().split(/\s+/);
    if (inodes.delete(inode) && path) found.push({ table: "unix", path });
  }
  return { found, unknown: [...inodes] };
}

test("every option of the base is known to open a way, or none", () => {
  const help = execFileSync(kBase, ["--help"], { encoding: "utf8" });
  const options = [...help.matchAll(/^ {2}(?:-\w,)?(--[a-z-]+)/gm)].map(([, name]) => name);
  assert.ok(options.length > 30);
  const known = [...Object.keys(kOpens), ...kOpensNothing];
  assert.deepEqual(options.toSorted(), known.toSorted());
});

test("every socket of a base with everything is a known way", () => {
  const { found, unknown } = socketsOf(programs.base);
  const kDds = { least: 7400, most: 7700 };
  const nameOf = ({ table, port, path, peer }) => {
    if (table === "unix") return path === commandSocket ? "command socket" : `unix ${path}`;
    if (table === "tcp" && port === programs.port) return "console";
    if (table === "tcp" && port === foxglove) return "Foxglove";
    if (table === "udp" && port === Number(programs.radio.split(":")[1])) return "radio";
    if (table === "udp" && port === stopPort) return "stop port";
    if (table === "udp" && port >= kDds.least && port <= kDds.most) return "DDS";
    if (table === "udp" && port === 7667) return "LCM";
    return `${table} ${port} (peer ${peer})`;
  };
  const names = new Set(found.map(nameOf));
  const free = [...names].filter((name) => /^udp6? \d/.test(name)).length;
  // LCM and DDS send from ports that the kernel chooses; what comes to them is read by nobody.
  const known = ["console", "Foxglove", "radio", "stop port", "command socket", "DDS", "LCM"];
  const others = [...names].filter((name) => !known.includes(name) && !/^udp6? \d/.test(name));
  assert.deepEqual(others, [], "sockets that nobody knows");
  for (const name of known.filter((way) => way !== "LCM")) assert.ok(names.has(name), name);
  assert.ok(free <= 4, `${free} ports for sending`);
  assert.deepEqual(unknown, [], "sockets of another kind");
});

test("in the source, commands come by these places, and one folder speaks to the car", () => {
  const sources = readdirSync(join(kRoot, "basestation"), { recursive: true })
    .filter((name) => /\.[ch]pp$/.test(name) && !name.includes("node_modules"))
    .map((name) => [name, readFileSync(join(kRoot, "basestation", name), "utf8")]);
  const having = (pattern) =>
    sources
      .filter(([, text]) => pattern.test(text))
      .map(([name]) => name)
      .toSorted();
  // Whoever has a request executed.
  assert.deepEqual(having(/[.>]execute\(/), [
    "inputs/command_socket.cpp",
    "inputs/text_operator.cpp",
    "publishers/console/console_service.cpp",
    "service/event_loop.cpp",
  ]);
  // Whoever can change what goes up to the car.
  assert.deepEqual(having(/(?<!const )(?<!const telemetry::)(?:telemetry::)?StationEndpoint&/), [
    "command/command_queue.cpp",
    "command/command_queue.hpp",
    "command/request_executor.cpp",
    "command/request_executor.hpp",
    "link/station.hpp",
  ]);
  assert.deepEqual(having(/(?<!const )telemetry::AuthorityRegister&/), [
    "command/authority_handover.hpp",
  ]);
  assert.deepEqual(having(/[.>]steer\(/), ["inputs/text_operator.cpp", "session/car_session.cpp"]);
  assert.deepEqual(having(/joystick\(\)\.sample\(/), ["command/request_executor.cpp"]);
  // Publishers only publish.
  assert.deepEqual(having(/create_datareader|create_subscriber|lcm_subscribe|lcm_handle/), []);
});

/** The answers of the command socket to lines. */
async function ask(...lines) {
  const client = connect(commandSocket);
  let said = "";
  client.on("data", (part) => (said += part));
  client.write(lines.map((line) => `${line}\n`).join(""));
  await eventually("answers", () => said.split("\n").length > lines.length);
  client.end();
  return said.trim().split("\n");
}

/** Console, command socket and script: what each was told of the same command. */
async function refusals() {
  const console_ = await Client.open(address);
  console_.say({ type: "authority", do: "take" });
  await console_.until("authority", () => console_.newest.authority?.holder >= 16);
  console_.say(kStaged);
  const { client } = console_.newest.hello;
  const { ticket } = await console_.until("gates", () => {
    const staged = console_.newest.command;
    return staged?.console === client && staged;
  });
  console_.say({ type: "send", ticket });
  const byConsole = (await console_.until("a refusal", () => console_.newest.error)).what;
  console_.say({ type: "authority", do: "drop" });
  await console_.until("nobody", () => console_.newest.authority.holder === 0);
  const [, bySocket] = await ask("take 1", kCommand, "drop");
  const byScript = programs.baseSaid.match(/refused: (gates: .*)/)?.[1];
  const audit = () => console_.texts.filter((text) => text.type === "audit");
  await console_.until("the audit lines", () => audit().some((l) => l.who === "command socket"));
  const lines = audit().map(({ who, result }) => `${who}: ${result}`);
  console_.close();
  return { byConsole, bySocket: bySocket.replace(/^refused: /, ""), byScript, lines };
}

/** The words without the gate that depends on where on the track the car is at the time. */
const anywhere = (words) => words?.replace(/ corner: [^;]*;/, "");

test("console, command socket and script are refused with the same words", async () => {
  const said = await refusals();
  assert.match(said.byConsole, kRefusal);
  assert.equal(anywhere(said.bySocket), anywhere(said.byConsole));
  assert.equal(anywhere(said.byScript), anywhere(said.byConsole));
  for (const who of [
    /^console \d+: refused: gate/,
    /^command socket: refused/,
    /^script: refused/,
  ]) {
    assert.ok(
      said.lines.some((line) => who.test(line)),
      `${who}:\n${said.lines.join("\n")}`,
    );
  }
  assert.doesNotMatch(programs.carSaid, /command/);
});

const datagram = (port, text) =>
  new Promise((done) => {
    const socket = createSocket("udp4");
    socket.send(text, port, "127.0.0.1", () => socket.close(done));
  });

test("what is no way changes nothing, at any port", async () => {
  const radio = Number(programs.radio.split(":")[1]);
  for (const text of [kCommand, "stop emergency", JSON.stringify(kStaged)]) {
    await datagram(radio, text);
  }
  await datagram(stopPort, kCommand);
  const viewer = new WebSocket(`ws://127.0.0.1:${foxglove}`, ["foxglove.sdk.v1"]);
  const heard = [];
  viewer.on("message", (data, isBinary) => !isBinary && heard.push(JSON.parse(String(data))));
  await eventually("Foxglove", () => heard.find((message) => message.op === "serverInfo"));
  const { capabilities } = heard.find((message) => message.op === "serverInfo");
  assert.ok(!capabilities.includes("clientPublish") && !capabilities.includes("services"));
  const channel = { id: 1, topic: "/command", encoding: "json", schemaName: "" };
  viewer.send(JSON.stringify({ op: "advertise", channels: [channel] }));
  const parameters = [{ name: "speed limit", value: 90 }];
  viewer.send(JSON.stringify({ op: "setParameters", parameters }));
  viewer.send(Buffer.concat([Buffer.from([1, 1, 0, 0, 0]), Buffer.from(JSON.stringify(kStaged))]));
  for (const [method, path] of [
    ["POST", "/api/command"],
    ["POST", "/ws"],
    ["PUT", "/metrics"],
    ["POST", "/"],
  ]) {
    const answer = await fetch(`${address}${path}`, { method, body: JSON.stringify(kStaged) });
    assert.ok(answer.status >= 400, `${method} ${path}: ${answer.status}`);
  }
  await sleep(500);
  assert.doesNotMatch(programs.carSaid, /command|stop/);
  assert.match(programs.baseSaid, /stop port: .*refused: only stops/);
  viewer.terminate();
});

test("a stop comes by each of its ways", async () => {
  await datagram(stopPort, "stop controlled");
  await programs.carHas("stop 1");
  assert.deepEqual(await ask("stop emergency"), ["done"]);
  await programs.carHas("stop 2");
});
