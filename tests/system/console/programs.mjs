/**
 * The real base with its console, and a car's end of the radio, as processes of a test.
 */
// SPDX-License-Identifier: Apache-2.0
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { kClockFlags } from "../../support/test_clock.mjs";
import { eventually, kPatienceMs } from "./client.mjs";
import { kRoot } from "./packages.mjs";

export const kBase =
  process.env.PITWALL_BASE ?? join(kRoot, "build/release/basestation/pitwall-base");
const kCar =
  process.env.PITWALL_CAR ?? join(kRoot, "build/release/tests/system/basestation/radio_car");
const kConsole = join(kRoot, "build/console/dist");

/** Resolves with the match of `pattern` in what the process says on stderr. */
function said(process, patterns) {
  return new Promise((resolve, reject) => {
    let text = "";
    const timer = setTimeout(() => reject(new Error(`said only: ${text}`)), kPatienceMs);
    process.on("exit", (code) => reject(new Error(`ended with ${code}: ${text}`)));
    process.stderr.on("data", (part) => {
      text += part;
      const found = patterns.map((pattern) => pattern.exec(text));
      if (found.every(Boolean)) {
        clearTimeout(timer);
        resolve(found.map((match) => match[1]));
      }
    });
  });
}

const ended = (process) =>
  process.exitCode !== null || process.signalCode !== null
    ? Promise.resolve()
    : new Promise((done) => process.once("exit", done));

export class Programs {
  folder = mkdtempSync(join(tmpdir(), "pitwall-console-"));
  /** What the car said: "stop LEVEL", "command NAME ARGUMENT". */
  carSaid = "";
  /** What the newest base said on stderr. */
  baseSaid = "";

  constructor() {
    mkdirSync(join(this.folder, "layouts"));
    execFileSync(kBase, ["keygen", "--out", join(this.folder, "keys")]);
  }

  /** Starts the base; resolves with the address of its console. */
  async startBase(...flags) {
    this.base = spawn(
      kBase,
      [
        "--keys",
        join(this.folder, "keys/base.keys"),
        "--listen",
        this.radio ?? "127.0.0.1:0",
        "--web",
        String(this.port ?? 0),
        "--track",
        "lvms",
        "--layouts",
        join(this.folder, "layouts"),
        "--console-dir",
        kConsole,
        ...kClockFlags,
        ...flags,
      ],
      { stdio: ["ignore", "pipe", "pipe"] },
    );
    this.base.stdout.resume();
    this.baseSaid = "";
    this.base.stderr.on("data", (part) => (this.baseSaid += part));
    const [address, radio] = await said(this.base, [
      /console at (http:\/\/[\d.]+:\d+)\s/,
      /listening at ([\d.]+:\d+)\s/,
    ]);
    this.radio = radio;
    this.port = Number(new URL(address).port);
    return address;
  }

  /** Starts a base that plays a recording; resolves with the address of its console. */
  async startReplay(recording) {
    this.base = spawn(
      kBase,
      ["--replay", recording, "--web", "0", "--track", "lvms", "--console-dir", kConsole],
      { stdio: ["ignore", "ignore", "pipe"] },
    );
    return (await said(this.base, [/console at (http:\/\/[\d.]+:\d+)\s/]))[0];
  }

  startCar(seconds = 120, keys = "keys/car.keys") {
    this.car = spawn(kCar, [join(this.folder, keys), this.radio, String(seconds)], {
      stdio: ["ignore", "pipe", "inherit"],
    });
    this.car.stdout.on("data", (part) => (this.carSaid += part));
  }

  /** Resolves when the car has said so: its pipe may be behind what a page shows. */
  carHas(said) {
    return eventually(`the car's word ${said}`, () => this.carSaid.includes(said));
  }

  async kill(name) {
    this[name]?.kill("SIGKILL");
    if (this[name]) await ended(this[name]);
    this[name] = undefined;
  }

  async close() {
    await this.kill("car");
    await this.kill("base");
    for (const name of this.others ?? []) await this.kill(name);
    rmSync(this.folder, { recursive: true, force: true });
  }
}
