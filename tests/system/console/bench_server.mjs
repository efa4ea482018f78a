/**
 * A real bench server beside the base of a test, and how its run stands on a page.
 */
// SPDX-License-Identifier: Apache-2.0
import { execFileSync, spawn } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { kRoot } from "./packages.mjs";
import { until } from "./stage.mjs";

const kBench = process.env.PITWALL_HIL ?? join(kRoot, "build/release/hil/pitwall-hil");
const kCopied = ["launch_and_stop.yaml", "red_flag_stop.yaml"];
/** And the one of writeParked(). */
export const kScenarios = [...kCopied, "parked_car.yaml"];

/** Of a sweep that has ended and whose page is gone. */
const kSummary = {
  name: "grip_and_wind",
  scenario: "hil/scenarios/grip_low.yaml",
  cases: 200,
  passed: 197,
  failed: 2,
  contact: 1,
  refused: 0,
  crashed: 0,
};

/** A car that stands on our line, which nothing avoids yet. */
function writeParked(path) {
  const ghosts = readFileSync(join(kRoot, "hil/scenarios/five_ghosts.yaml"), "utf8");
  const parked =
    "{name: parked, number: 9, kind: ghost, start: {s_m: 150, speed_mps: 0}, offset_m: 0, " +
    "speed: {mps: 0}}";
  writeFileSync(
    path,
    ghosts
      .replace("name: five_ghosts", "name: parked_car")
      .replace("cars:\n", `cars:\n  - ${parked}\n`),
  );
}

export const sweepsOf = (programs) => join(programs.folder, "sweeps");

/** A real sweep of two cases, of which one fails and has a page. */
export function sweepRoundSpeed(programs) {
  const plan = join(programs.folder, "round_speed.yaml");
  writeFileSync(
    plan,
    `schema: 1
name: round_speed
scenario: hil/scenarios/launch_and_stop.yaml
seed: 1
combine: all
parameters:
  - {path: "race_control[3].round_target_speed_mph", values: [60, 80]}
`,
  );
  const out = join(sweepsOf(programs), "round_speed");
  try {
    execFileSync(kBench, ["sweep", plan, "--out", out, "--pages", "1"], { cwd: kRoot });
  } catch (failed) {
    if (failed.status !== 1) throw failed; // 1: a case failed
  }
}

export const socketOf = (programs) => join(programs.folder, "server");

/** As `bench` of the test's programs, so that it ends with them. */
export function startBenchServer(programs, ...more) {
  const scenarios = join(programs.folder, "scenarios");
  mkdirSync(scenarios, { recursive: true });
  for (const name of kCopied) cpSync(join(kRoot, "hil/scenarios", name), join(scenarios, name));
  writeParked(join(scenarios, "parked_car.yaml"));
  const runs = join(programs.folder, "runs");
  const sweeps = sweepsOf(programs);
  mkdirSync(join(sweeps, "grip"), { recursive: true });
  writeFileSync(join(sweeps, "grip/summary.json"), JSON.stringify(kSummary));
  programs.bench = spawn(
    kBench,
    [
      "serve",
      "--socket",
      socketOf(programs),
      "--scenarios",
      scenarios,
      "--runs",
      runs,
      "--sweeps",
      sweeps,
      ...more,
    ],
    { cwd: kRoot, stdio: ["ignore", "ignore", "inherit"] },
  );
  programs.others = ["bench"];
}

export const stateIs = (page, state) =>
  until(
    page,
    `a run that is ${state}`,
    (wanted) => document.querySelector(".verdict")?.dataset.state === wanted,
    state,
  );

/** The page of the bench, with what the server offers. */
export async function benchPage(stage) {
  const opened = await stage.open({ hash: "#/hil", ready: ".scenarios li" });
  await until(
    opened.page,
    "every scenario",
    (count) => document.querySelectorAll(".scenarios li").length === count,
    kScenarios.length,
  );
  return opened;
}
