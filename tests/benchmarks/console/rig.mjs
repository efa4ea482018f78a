/**
 * What the measurements of the console share: the real base as a process, a car that tells when its
 * packets leave, consoles without a browser, and arithmetic. Times are ms of the monotonic clock,
 * which all processes of one machine have in common.
 */
// SPDX-License-Identifier: Apache-2.0
import { spawn } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { createInterface } from "node:readline";
import { Programs } from "../../system/console/programs.mjs";
import { Client } from "../../system/console/client.mjs";

export const kNumberPath = "flags.round_target_speed";
export const kMphPerMps = 2.2369362920544;
/** The car's numbers come round: see measured_car.cpp. */
const kNumbers = 180;
const kFrameHeader = 24;
const kEntry = 8;
const kPoint = 16;

export const now = () => Number(process.hrtime.bigint()) / 1e6;
export const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** The value below which this share of the sample lies; undefined of none. */
export function quantile(sample, share) {
  const sorted = [...sample].sort((a, b) => a - b);
  return sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)];
}

/** How much later than `a` the number `b` was counted, when one came round at most half a turn. */
const ahead = (a, b) =>
  ((((b - a + kNumbers / 2) % kNumbers) + kNumbers) % kNumbers) - kNumbers / 2;

/**
 * Of each number that left: how long until it, or a later one, was seen. Both lists have
 * `{number, at}` in order of time; a number that nobody saw counts as endless.
 */
export function delays(left, seen) {
  let from = 0;
  return left.map(({ number, at }) => {
    while (from < seen.length && (seen[from].at < at || ahead(number, seen[from].number) < 0)) {
      ++from;
    }
    return from < seen.length ? seen[from].at - at : Infinity;
  });
}

/** The base and its car, the car's lines read. */
export class Rig {
  programs = new Programs();
  /** First packets of each number: {number, at}; the newest packet; stops: {level, at}. */
  left = [];
  newest = undefined;
  stops = [];

  async start(seconds, ...flags) {
    this.address = await this.programs.startBase(...flags);
    this.programs.startCar(seconds);
    createInterface({ input: this.programs.car.stdout }).on("line", (line) => this.#hear(line));
    const { fields } = await (await fetch(`${this.address}/api/catalogue`)).json();
    this.fields = fields;
    this.numberField = fields.find(({ path }) => path === kNumberPath).id;
    this.linkState = fields.find(({ path }) => path === "link.state");
  }

  #hear(line) {
    const [what, value, time] = line.split(" ");
    const at = Number(BigInt(time ?? 0)) / 1e6;
    if (what === "stop") this.stops.push({ level: Number(value), at });
    if (what !== "packet") return;
    this.newest = { number: Number(value), at };
    if (this.left.at(-1)?.number !== Number(value)) this.left.push(this.newest);
  }

  /** What the base's threads have used of the processor so far, in ms. */
  busyMs() {
    const tasks = `/proc/${this.programs.base.pid}/task`;
    const ns = (task) => Number(readFileSync(`${tasks}/${task}/schedstat`, "utf8").split(" ")[0]);
    return readdirSync(tasks).reduce((sum, task) => sum + ns(task), 0) / 1e6;
  }

  /** What the base has in memory, in MB. */
  residentMb() {
    const status = readFileSync(`/proc/${this.programs.base.pid}/status`, "utf8");
    return Number(/^VmRSS:\s+(\d+) kB$/m.exec(status)[1]) / 1024;
  }

  /** What the base keeps of the last hour, in MB. */
  async historyMb() {
    const text = await (await fetch(`${this.address}/metrics`)).text();
    return Number(/^pitwall_history_bytes\{[^}]*\} (\S+)$/m.exec(text)[1]) / (1024 * 1024);
  }

  close() {
    return this.programs.close();
  }
}

/**
 * What a reference unit (tests/benchmarks/cost) costs in the meantime: its program, and what that
 * said.
 */
export class ReferencePulse {
  /** {at, times}: how many times what it costs on the reference machine. */
  beats = [];

  constructor() {
    this.process = spawn(process.env.PITWALL_PULSE, { stdio: ["ignore", "pipe", "inherit"] });
    createInterface({ input: this.process.stdout }).on("line", (line) => {
      const [here, there] = line.split(" ").map(Number);
      this.beats.push({ at: now(), times: here / there });
    });
  }

  /** The median in this time; undefined where there was none. */
  times(from, to) {
    const beats = this.beats.filter(({ at }) => at >= from && at < to);
    return quantile(
      beats.map(({ times }) => times),
      0.5,
    );
  }

  close() {
    this.process.kill("SIGKILL");
  }
}

/** A console without a browser that notes when each number and each state of the link came. */
export class Viewer extends Client {
  seen = [];
  entries = 0;
  linkStates = [];
  /** Of each field that was asked for: its values, oldest first. */
  histories = new Map();

  constructor(rig) {
    super();
    this.rig = rig;
  }

  take(bytes, isBinary) {
    const at = now();
    super.take(bytes, isBinary);
    if (isBinary && bytes[0] === 2) this.#keepHistory(bytes);
    if (!isBinary || bytes[0] !== 1) return;
    const count = bytes.readUInt16LE(4);
    this.entries += count;
    for (let entry = kFrameHeader; entry < kFrameHeader + count * kEntry; entry += kEntry) {
      const id = bytes.readUInt16LE(entry);
      const value = bytes.readFloatLE(entry + 4);
      if (id === this.rig.numberField) {
        this.seen.push({ number: Math.round(value * kMphPerMps), at });
      } else if (id === this.rig.linkState.id) {
        this.linkStates.push({ state: this.rig.linkState.labels[value], at });
      }
    }
  }

  #keepHistory(bytes) {
    const values = [];
    for (let at = kFrameHeader + kEntry; at < bytes.length; at += kPoint) {
      values.push(bytes.readFloatLE(at + 8));
    }
    this.histories.set(bytes.readUInt16LE(kFrameHeader), values);
  }
}

/** Something was waited for, and did not come. */
export class InVain extends Error {}

/** Resolves with what `find` gives once that is true; InVain when it takes long. */
export async function eventually(what, find, patienceMs = 5000) {
  const end = now() + patienceMs;
  for (;;) {
    const found = await find();
    if (found) return found;
    if (now() > end) throw new InVain(`waited ${patienceMs} ms in vain for: ${what}`);
    await pause(5);
  }
}
