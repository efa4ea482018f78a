/**
 * A real base and a real car that stands, with an honest radio between them and a console at the
 * base; restarted one by one where a measurement wants it. Times are ms of the monotonic clock.
 */
// SPDX-License-Identifier: Apache-2.0
import { spawn } from "node:child_process";
import { createSocket } from "node:dgram";
import { once } from "node:events";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { Client } from "../../system/console/client.mjs";
import { kRoot } from "../../system/console/packages.mjs";
import { Programs } from "../../system/console/programs.mjs";
import { eventually, now, pause } from "../console/rig.mjs";
import { smallDisk } from "./limits.mjs";

const kVehicle =
  process.env.PITWALL_VEHICLE ?? join(kRoot, "build/release/vehicle/pitwall-vehicle");
const kPrograms =
  process.env.PITWALL_ATTACK_PROGRAMS ?? join(kRoot, "build/release/tests/benchmarks/attack");
export const kCarFile = join(kRoot, "vehicle/config/cars/av21.yaml");
const kTrackFile = join(kRoot, "vehicle/config/tracks/lvms.yaml");
/** One way, of the honest radio. */
export const kDelayMs = 5;
const kNsPerMs = 1e6;
const kFrameHeader = 24;
const kEntry = 8;
const kOperator = "operator-4f1c9a7be2d05586";
export const kViewer = "viewer-88f7d1c2a95be340";
const kCrowd = fileURLToPath(new URL("crowd.mjs", import.meta.url));
/** Who goes past the gate that wants a car that knows where it is, and why. */
const kSecond = "second-0c3a5f77e19b42d8";
const kWhy = "it stands at its box";
const kStageEachMs = 250;
const kReleaseName = "release stop";

/** One of our own programs: its lines are heard, it ends when its input does. */
export class Tool {
  said = "";

  constructor(name, args, hear = () => {}, program = join(kPrograms, name)) {
    this.process = spawn(program, args.map(String), {
      stdio: ["pipe", "pipe", "inherit"],
    });
    this.lines = [];
    createInterface({ input: this.process.stdout }).on("line", (line) => {
      const words = line.split(" ");
      if (words[0] === "port") this.port ??= Number(words[1]);
      hear(words);
    });
  }

  say(text) {
    this.process.stdin.write(`${text}\n`);
  }

  async ready() {
    await eventually("a program's port", () => this.port);
    return this;
  }

  close() {
    this.process.kill("SIGKILL");
  }
}

export async function freePort() {
  const socket = createSocket("udp4").bind(0, "127.0.0.1");
  await once(socket, "listening");
  const { port } = socket.address();
  await new Promise((done) => socket.close(done));
  return port;
}

/** A console without a browser that notes how long the link was silent, and lets stops go. */
export class Console extends Client {
  silences = [];
  #staged = -Infinity;

  take(bytes, isBinary) {
    super.take(bytes, isBinary);
    if (!isBinary || bytes[0] !== 1) return;
    const fields = this.newest.catalogue?.fields ?? [];
    this.silence ??= fields.find(({ path }) => path === "link.silence_ms")?.id;
    this.challengeField ??= fields.find(({ path }) => path === "mode.stop_challenge")?.id;
    const end = kFrameHeader + bytes.readUInt16LE(4) * kEntry;
    for (let entry = kFrameHeader; entry < end; entry += kEntry) {
      const field = bytes.readUInt16LE(entry);
      const value = bytes.readFloatLE(entry + 4);
      if (field === this.challengeField) this.challenge = value;
      if (field === this.silence && Number.isFinite(value)) {
        this.silences.push({ at: now(), value });
      }
    }
  }

  /** The next step of a release: the authority, the command, its sending past the gate. */
  letGo() {
    const { authority, hello, command } = this.newest;
    if (authority?.holder !== hello.client) return this.#each({ type: "authority", do: "take" });
    if (!(this.challenge > 0)) return;
    const open = command?.name === kReleaseName && ["staged", "gated"].includes(command.step);
    if (open && command.ticket !== this.sent) {
      this.sent = command.ticket;
      const override = { reason: kWhy, token: kSecond };
      return this.say({ type: "send", ticket: command.ticket, override });
    }
    this.#each({ type: "stage", name: kReleaseName, argument: this.challenge });
  }

  /** Not more often than a client is heard. */
  #each(message) {
    if (now() < this.#staged + kStageEachMs) return;
    this.#staged = now();
    this.say(message);
  }
}

/** What a process has used of a processor, in ms, and has in memory, in MB; 0 when it is gone. */
function usage(process_) {
  try {
    const tasks = `/proc/${process_.pid}/task`;
    const ns = (task) => Number(readFileSync(`${tasks}/${task}/schedstat`, "utf8").split(" ")[0]);
    const busy = readdirSync(tasks).reduce((sum, task) => sum + ns(task), 0) / kNsPerMs;
    const status = readFileSync(`/proc/${process_.pid}/status`, "utf8");
    return { busy, resident: Number(/^VmRSS:\s+(\d+) kB$/m.exec(status)[1]) / 1024 };
  } catch {
    return { busy: 0, resident: 0 };
  }
}

export class Pair {
  programs = new Programs();
  /** What the car says of itself, newest last: {at, stop, age, accepted, refused}. */
  reports = [];
  /** Of the console that there is now, and those before it. */
  consoles = [];

  constructor(name) {
    this.name = name;
  }

  get keys() {
    return join(this.programs.folder, "keys/car.keys");
  }
  get console() {
    return this.consoles.at(-1);
  }
  get newest() {
    return this.reports.at(-1);
  }

  /** The radio and the car's bus; `copies`: port of who hears everything. */
  async prepare(basePort, copies) {
    this.programs.radio = `127.0.0.1:${basePort}`;
    this.bus = `unix:${join(this.programs.folder, "bus")}`;
    this.stand = await new Tool("standing_car", [this.bus], (words) => this.#hear(words)).ready();
    this.tokens = join(this.programs.folder, "tokens");
    const lines = `operator ${kOperator} Anna\noperator ${kSecond} Ben\nviewer ${kViewer} Garage\n`;
    writeFileSync(this.tokens, lines, { mode: 0o600 });
    this.recording = join(this.programs.folder, "recording");
    this.unmount = smallDisk(this.recording);
    const more = copies === undefined ? [] : [copies];
    this.radio = await new Tool("attack_radio", [basePort, kDelayMs, ...more]).ready();
  }

  #hear([what, ns, ...numbers]) {
    if (what !== "report") return;
    const [stop, age, accepted, refused] = numbers.map(Number);
    this.reports.push({ at: Number(BigInt(ns)) / kNsPerMs, stop, age, accepted, refused });
  }

  async startBase() {
    const flags = ["--web-tokens", this.tokens, "--record", this.recording];
    this.address = await this.programs.startBase(...flags);
    this.baseSince = now();
    this.consoles.push(await Client.open(this.address, new Console(), "", kOperator));
  }

  /** ms until an operator with a token who comes now is there; the limit where nobody lets him. */
  async comes(limitMs) {
    const from = now();
    for (const end = from + limitMs; now() < end;) {
      const client = new Client();
      const opened = await Client.open(this.address, client, "", kOperator).catch(() => undefined);
      client.socket.terminate();
      if (opened) return now() - from;
    }
    return limitMs;
  }

  /** A crowd at this base's console; resolves when every one was there. */
  async crowd({ kind, count }) {
    const token = kind === "marks" || kind === "viewers" ? [kViewer] : [];
    const heard = {};
    const hear = ([word, number]) => (heard[word] = Number(number ?? 1));
    const words = [kCrowd, kind, count, this.address, ...token];
    this.visitors = new Tool("crowd", words, hear, process.execPath);
    this.visitors.heard = heard;
    await eventually("a crowd", () => heard.begun);
  }

  startCar() {
    this.programs.car = startVehicle({
      bus: this.bus,
      reports: this.stand.port,
      radio: this.radio.port,
      keys: this.keys,
      receivers: this.receivers,
    });
    this.carSince = now();
  }

  /** Kills and starts again; resolves with since when there could be a link. */
  async restart(what) {
    if (what === "base") {
      this.console.close();
      await this.programs.kill("base");
      await this.startBase();
      return this.baseSince;
    }
    await this.programs.kill("car");
    this.startCar();
    return this.carSince;
  }

  /** How long after `since` the car had a packet of the base that was sent later; or the limit. */
  async linkedAfter(since, limitMs) {
    const linked = () =>
      this.reports.findLast(({ at, age }) => age >= 0 && at - age > since + 2 * kDelayMs);
    while (now() < since + limitMs && !linked()) await pause(5);
    const first = this.reports.find(({ at, age }) => age >= 0 && at - age > since + 2 * kDelayMs);
    return first ? first.at - first.age - since : limitMs;
  }

  /** True while both ends hear each other. */
  get linked() {
    const silence = this.console.silences.at(-1);
    const fresh = silence !== undefined && now() - silence.at < 500 && silence.value < 300;
    const { at, age } = this.newest ?? { age: -1 };
    return fresh && age >= 0 && age < 300 && now() - at < 300;
  }

  /** ms from what the console says to the latch in the car; the limit where it never came. */
  async press(limitMs) {
    const pressed = now();
    this.console.say({ type: "stop", kind: "emergency" });
    const latched = () => this.reports.findLast(({ at, stop }) => at > pressed && stop > 0);
    while (now() < pressed + limitMs && !latched()) await pause(3);
    const first = this.reports.find(({ at, stop }) => at > pressed && stop > 0);
    return first ? first.at - pressed : limitMs;
  }

  /** True when the car has let go of the stop. */
  async release(limitMs) {
    for (const end = now() + limitMs; now() < end;) {
      if (this.newest.stop === 0 && now() - this.newest.at < 300) return true;
      this.console.letGo();
      await pause(60);
    }
    return false;
  }

  /** What was noted before now, but the newest of it. */
  forget() {
    this.reports = this.reports.slice(-1);
    this.consoles = [this.console];
    this.console.silences = this.console.silences.slice(-1);
    this.console.texts = [];
  }

  usage() {
    return { base: usage(this.programs.base), car: usage(this.programs.car) };
  }

  /** Packets of the car that the base took, and datagrams that it refused, since it started. */
  async counts() {
    const headers = { Authorization: `Bearer ${kViewer}` };
    const text = await (await fetch(`${this.address}/metrics`, { headers })).text();
    const sum = (name) =>
      text
        .split("\n")
        .filter((line) => line.startsWith(`${name}{`) || line.startsWith(`${name} `))
        .reduce((total, line) => total + Number(line.split(" ").at(-1)), 0);
    return {
      packets: sum("pitwall_packets_total"),
      refused: sum("pitwall_datagrams_refused_total"),
      of: sum,
    };
  }

  async close() {
    this.visitors?.close();
    this.console?.close();
    this.radio?.close();
    this.stand?.close();
    await this.programs.kill("base");
    this.unmount?.();
    await this.programs.close();
  }
}

/** A pitwall-vehicle. Its process; what it says on stderr goes nowhere. */
export function startVehicle({ bus, reports, radio, keys, receivers, carFile = kCarFile }) {
  const words = ["--car", carFile, "--track", kTrackFile, "--can", bus, "--gnss", receivers];
  words.push("--radio", `127.0.0.1:${radio}`, "--local-report", reports, "--keys", keys);
  return spawn(kVehicle, [...words.map(String), "--simulation"], { stdio: "ignore" });
}
