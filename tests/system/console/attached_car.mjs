/**
 * The unmodified car program on a bus over a Unix socket, with the bench's plant behind it, on the
 * base of a test.
 */
// SPDX-License-Identifier: Apache-2.0
import { spawn } from "node:child_process";
import { openSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { kClockFlags } from "../../support/test_clock.mjs";
import { kRoot } from "./packages.mjs";

const kBench = process.env.PITWALL_HIL ?? join(kRoot, "build/release/hil/pitwall-hil");
const kVehicle =
  process.env.PITWALL_VEHICLE ?? join(kRoot, "build/release/vehicle/pitwall-vehicle");
const kHubBeginsMs = 500;

/** What car and bench have said. */
export const saidBy = (programs) => readFileSync(join(programs.folder, "said"), "utf8");

/** The car armed on its bus, and the scenario; they end with the programs of the test. */
export async function attachCar(programs, scenario, durationS) {
  const said = openSync(join(programs.folder, "said"), "a");
  programs.others ??= [];
  const start = (name, program, ...words) => {
    programs[name] = spawn(program, words, { cwd: kRoot, stdio: ["ignore", said, said] });
    programs.others.push(name);
    return programs[name];
  };
  const bus = `unix:${join(programs.folder, "bus")}`;
  start("hub", kBench, "bus", "hub", bus, ...kClockFlags);
  await sleep(kHubBeginsMs);
  const config = (name) => join(kRoot, "vehicle/config", name);
  const vehicle = start(
    "vehicle",
    kVehicle,
    ...["--car", config("cars/av21.yaml"), "--track", config("tracks/lvms.yaml"), "--can", bus],
    ...["--gnss", "23501,23502", "--radio", programs.radio, "--local-report", "23436"],
    ...["--keys", join(programs.folder, "keys/car.keys"), "--simulation", "--arm"],
    ...["--record", join(programs.folder, "box"), ...kClockFlags],
  );
  const out = ["--out", join(programs.folder, "out"), "--duration", String(durationS)];
  const live = ["--live", "--here", "--attach", "--interface", bus, ...kClockFlags];
  start("bench", kBench, "run", scenario, ...live, ...out);
  return vehicle;
}
