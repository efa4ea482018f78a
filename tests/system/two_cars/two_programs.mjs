/**
 * The real base with two cars, each with keys, a radio and a recording of its own, and the cars'
 * ends of the radio, as processes of a test.
 */
// SPDX-License-Identifier: Apache-2.0
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { kClockFlags } from "../../support/test_clock.mjs";
import { kRoot } from "../console/packages.mjs";

const kBase = process.env.PITWALL_BASE ?? join(kRoot, "build/release/basestation/pitwall-base");
const kCar =
  process.env.PITWALL_CAR ?? join(kRoot, "build/release/tests/system/basestation/radio_car");
const kPatienceMs = 60_000;

export const kNames = { 7: "Caracara", 8: "Shrike" };

const ended = (process) =>
  process.exitCode !== null || process.signalCode !== null
    ? Promise.resolve()
    : new Promise((done) => process.once("exit", done));

export class TwoPrograms {
  folder = mkdtempSync(join(tmpdir(), "pitwall-two-"));
  cars = new Map();
  /** What each car said: "stop LEVEL", "command NAME ARGUMENT". */
  carSaid = { 7: "", 8: "" };
  /** Where the base hears each. */
  radio = {};

  constructor() {
    let file = "cars:\n";
    for (const [number, name] of Object.entries(kNames)) {
      mkdirSync(join(this.folder, number));
      execFileSync(kBase, ["keygen", "--out", join(this.folder, number, "keys")]);
      file +=
        `  - {number: ${number}, name: ${name}, keys: ${number}/keys/base.keys,\n` +
        `     listen: ["127.0.0.1:0"], record: ${number}/recording,\n` +
        `     judgement: ${number}/judgement.yaml, json: ${number}/base.json}\n`;
    }
    this.file = join(this.folder, "cars.yaml");
    writeFileSync(this.file, file);
  }

  /** Resolves with the address of the console. */
  async startBase() {
    this.base = spawn(
      kBase,
      ["--cars", this.file, "--web", "0", "--track", "lvms"].concat([
        "--console-dir",
        join(kRoot, "build/console/dist"),
        ...kClockFlags,
      ]),
      { stdio: ["ignore", "ignore", "pipe"] },
    );
    let text = "";
    this.base.stderr.on("data", (part) => (text += part));
    const patterns = [
      /CAR 7 Caracara listening at ([\d.]+:\d+)\s/,
      /CAR 8 Shrike listening at ([\d.]+:\d+)\s/,
      /console at (http:\/\/[\d.]+:\d+)\s/,
    ];
    for (const end = Date.now() + kPatienceMs; ;) {
      const found = patterns.map((pattern) => pattern.exec(text)?.[1]);
      if (found.every(Boolean)) {
        [this.radio[7], this.radio[8]] = found;
        return found[2];
      }
      if (Date.now() > end || this.base.exitCode !== null) throw new Error(`said only: ${text}`);
      await new Promise((done) => setTimeout(done, 20));
    }
  }

  /** Starts a car; `keysOf` and `at` for one that speaks where it has no business. */
  startCar(number, { keysOf = number, at = number, as = String(number) } = {}) {
    const keys = join(this.folder, String(keysOf), "keys/car.keys");
    const car = spawn(kCar, [keys, this.radio[at], "300"], {
      stdio: ["ignore", "pipe", "inherit"],
    });
    car.stdout.on("data", (part) => {
      if (as in this.carSaid) this.carSaid[as] += part;
    });
    this.cars.set(as, car);
  }

  async killCar(as) {
    const car = this.cars.get(String(as));
    car.kill("SIGKILL");
    await ended(car);
  }

  /** Ends the base as a person does, and gives what it says of each car at the end. */
  async summaries() {
    this.base.kill("SIGTERM");
    await ended(this.base);
    return Object.fromEntries(
      Object.keys(kNames).map((number) => [
        number,
        JSON.parse(readFileSync(join(this.folder, number, "base.json"), "utf8")),
      ]),
    );
  }

  async close() {
    for (const process of [...this.cars.values(), this.base]) {
      process?.kill("SIGKILL");
      if (process) await ended(process);
    }
    rmSync(this.folder, { recursive: true, force: true });
  }
}
