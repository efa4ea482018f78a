/**
 * The bench at the console: the real base, a real bench desk and its real runs. An operator starts
 * a scenario with a seed and sees it through to its verdict; a desk that dies is shown.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { cpSync, existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { kRoot } from "./packages.mjs";
import { baseStage, show, until } from "./stage.mjs";

const kBench = process.env.PITWALL_HIL ?? join(kRoot, "build/release/hil/pitwall-hil");
const kRunMs = 120_000;
let socket = "";
let folder = "";

const stage = baseStage({
  car: false,
  flags: (programs) => {
    folder = programs.folder;
    socket = join(folder, "desk");
    startDesk(programs);
    return ["--bench", socket];
  },
});

/** As `desk` of the test's programs, so that it ends with them. */
function startDesk(programs) {
  const scenarios = join(folder, "scenarios");
  mkdirSync(scenarios, { recursive: true });
  for (const name of ["launch_and_stop.yaml", "red_flag_stop.yaml"]) {
    cpSync(join(kRoot, "hil/scenarios", name), join(scenarios, name));
  }
  programs.desk = spawn(
    kBench,
    ["desk", "--socket", socket, "--scenarios", scenarios, "--runs", join(folder, "runs")],
    { cwd: kRoot, stdio: ["ignore", "ignore", "inherit"] },
  );
  programs.others = ["desk"];
}

const stateIs = (page, state, ms) =>
  until(
    page,
    `a run that is ${state}`,
    (wanted) => document.querySelector(".verdict")?.dataset.state === wanted,
    state,
    ms,
  );

async function benchPage() {
  const opened = await stage.open({ hash: "#/hil", ready: ".scenarios li" });
  await until(
    opened.page,
    "two scenarios",
    () => document.querySelectorAll(".scenarios li").length === 2,
  );
  return opened;
}

test("a scenario is found, started with a seed and seen through to its verdict", async () => {
  const { page, faults } = await benchPage();
  await page.fill(".chooser .filter", "red flag");
  await until(page, "one", () => document.querySelectorAll(".scenarios li").length === 1);
  assert.match(await page.textContent(".details"), /Red at full speed in a corner/);
  await page.fill(".starter input", "7.5");
  assert.equal(await page.isDisabled(".starter button"), true, "that is no seed");
  await page.fill(".starter input", "77");
  await page.click(".starter button");
  await stateIs(page, "passed", kRunMs);
  const text = await page.textContent(".hil-page");
  assert.match(text, /simulation/);
  assert.match(text, /seed 77/);
  assert.match(text, /junit\.xml/);
  assert.ok(existsSync(join(folder, "runs/1/junit.xml")), "the JUnit file is there");
  // What is shown is what the run told: each expectation holds, red has a reaction and a stop.
  const standings = await page.$$eval(".expectations li", (all) =>
    all.map((e) => e.dataset.standing),
  );
  assert.deepEqual(standings, Array(6).fill("holds"));
  const red = await page.$$eval('[aria-label="reactions"] tbody tr', (rows) =>
    [...rows].map((row) => [...row.children].map((cell) => cell.textContent)).at(-1),
  );
  assert.equal(red[0], "red");
  assert.ok(Number(red[3]) > 0 && Number(red[3]) < 2000, `reaction ${red[3]} ms`);
  assert.ok(Number(red[4]) > 50, `stop distance ${red[4]} m`);
  assert.equal(await page.locator('.lanes li[data-kind="flag"]').count(), 5);
  // Who comes later sees the same.
  const second = await benchPage();
  await stateIs(second.page, "passed");
  await show(page, "commands");
  await until(page, "the audit", () =>
    document.body.textContent.includes("bench: start red_flag_stop, lockstep, seed 77"),
  );
  assert.deepEqual(faults, []);
});

test("a run is stopped, and a desk that dies is shown until there is one again", async () => {
  const { page, faults } = await benchPage();
  await page.fill(".chooser .filter", "red flag");
  await page.click(".starter button");
  await stateIs(page, "running", 20_000);
  await page.click('.run button:has-text("Stop")');
  // A machine that is fast enough has finished it before.
  await until(page, "its end", () =>
    ["stopped", "passed"].includes(document.querySelector(".verdict")?.dataset.state),
  );
  await stage.programs.kill("desk");
  await until(page, "no desk", () => document.querySelector('.hil-page[data-up="false"]'));
  assert.equal(await page.isDisabled(".starter button"), true);
  startDesk(stage.programs);
  await until(
    page,
    "a desk",
    () => document.querySelector('.hil-page[data-up="true"]'),
    null,
    20_000,
  );
  await until(
    page,
    "no run of the old one",
    () => !document.querySelector(".starter button").disabled,
  );
  assert.deepEqual(faults, []);
});
