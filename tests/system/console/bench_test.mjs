/**
 * The bench at the console: the real base, a real bench server and its real runs. An operator
 * starts a scenario with a seed and sees it through to its verdict; a server that dies is shown.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { benchPage, socketOf, startBenchServer, stateIs } from "./bench_server.mjs";
import { baseStage, show, until } from "./stage.mjs";

const stage = baseStage({
  car: false,
  flags: (programs) => {
    startBenchServer(programs);
    return ["--bench", socketOf(programs)];
  },
});

test("a scenario is found, started with a seed and seen through to its verdict", async () => {
  const { page, faults } = await benchPage(stage);
  await page.fill(".chooser .filter", "red flag");
  await until(page, "one", () => document.querySelectorAll(".scenarios li").length === 1);
  assert.match(await page.textContent(".details"), /Red at full speed in a corner/);
  await page.fill(".starter input", "7.5");
  assert.equal(await page.isDisabled(".starter button"), true, "that is no seed");
  await page.fill(".starter input", "77");
  await page.click(".starter button");
  await stateIs(page, "passed");
  const text = await page.textContent(".hil-page");
  assert.match(text, /simulation/);
  assert.match(text, /seed 77/);
  assert.match(text, /junit\.xml/);
  assert.ok(existsSync(join(stage.programs.folder, "runs/1/junit.xml")), "the JUnit file is there");
  // What is shown is what the run told: each expectation holds, red has a reaction and a stop.
  const standings = await page.$$eval(".expectations li", (all) =>
    all.map((e) => e.dataset.standing),
  );
  assert.deepEqual(standings, Array(7).fill("holds"));
  const red = await page.$$eval('[aria-label="reactions"] tbody tr', (rows) =>
    [...rows].map((row) => [...row.children].map((cell) => cell.textContent)).at(-1),
  );
  assert.equal(red[0], "red");
  assert.ok(Number(red[3]) > 0 && Number(red[3]) < 2000, `reaction ${red[3]} ms`);
  assert.ok(Number(red[4]) > 50, `stop distance ${red[4]} m`);
  assert.equal(await page.locator('.lanes li[data-kind="flag"]').count(), 5);
  // Who comes later sees the same.
  const second = await benchPage(stage);
  await stateIs(second.page, "passed");
  await show(page, "commands");
  await until(page, "the audit", () =>
    document.body.textContent.includes("bench: start red_flag_stop, lockstep, seed 77"),
  );
  assert.deepEqual(faults, []);
});

test("sweeps that have ended are listed with their counts", async () => {
  const { page, faults } = await benchPage(stage);
  await until(page, "the sweep", () => document.querySelector(".sweeps li"));
  const text = await page.textContent(".sweeps li");
  assert.match(
    text,
    /FAILED grip_and_wind: 197 of 200 cases passed, 2 failed, 1 contact \(no page\)/,
  );
  assert.equal(await page.locator(".sweeps a").count(), 0, "its page is gone");
  assert.match(await page.getAttribute(".sweeps span", "title"), /sweeps\/grip\/report\.html$/);
  assert.deepEqual(faults, []);
});

test("a contact with another car is told with its cause, its rule and its place", async () => {
  const { page, faults } = await benchPage(stage);
  await page.fill(".chooser .filter", "parked");
  await until(page, "one", () => document.querySelectorAll(".scenarios li").length === 1);
  await page.click(".starter button");
  await stateIs(page, "contact");
  await until(page, "the contact", () => document.querySelector(".contact"));
  assert.equal(await page.textContent(".contact .sum b"), "THIS CAR");
  const panel = await page.textContent(".contact");
  assert.match(panel, /rule 1: a car that stood causes nothing/);
  assert.match(panel, /parked \(9\)/);
  assert.match(panel, /station14[0-9] m/, "a length before the middle of the other");
  assert.match(await page.textContent(".event-list"), /contact with parked/);
  assert.deepEqual(faults, []);
});

test("a run is stopped, and a server that dies is shown until there is one again", async () => {
  const { page, faults } = await benchPage(stage);
  await page.fill(".chooser .filter", "red flag");
  await page.click(".starter button");
  await stateIs(page, "running");
  await page.click('.run button:has-text("Stop")');
  // A machine that is fast enough has finished it before.
  await until(page, "its end", () =>
    ["stopped", "passed"].includes(document.querySelector(".verdict")?.dataset.state),
  );
  await stage.programs.kill("bench");
  await until(page, "no server", () => document.querySelector('.hil-page[data-up="false"]'));
  assert.equal(await page.isDisabled(".starter button"), true);
  startBenchServer(stage.programs);
  await until(page, "a server", () => document.querySelector('.hil-page[data-up="true"]'));
  await until(
    page,
    "no run of the old one",
    () => !document.querySelector(".starter button").disabled,
  );
  assert.deepEqual(faults, []);
});
