/**
 * A live run started at the console: real SocketCAN, in a guest where this kernel has none, the car
 * as a program of its own, and its radio on this very base, which goes by the time of the run. It
 * is stopped as soon as the car is seen to drive.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { benchPage, socketOf, startBenchServer, stateIs } from "./bench_server.mjs";
import { baseStage, show, until } from "./stage.mjs";

const clockOf = (programs) => join(programs.folder, "clock");

const stage = baseStage({
  car: false,
  flags: (programs) => ["--bench", socketOf(programs), "--clock", clockOf(programs)],
});

test("the car of a live run drives on the console that started it", async () => {
  const { programs } = stage;
  const port = programs.radio.split(":").at(-1);
  const keys = join(programs.folder, "keys");
  const clock = clockOf(programs);
  startBenchServer(programs, "--radio-port", port, "--keys", keys, "--clock", clock);
  const { page, faults } = await benchPage(stage);
  await page.fill(".chooser .filter", "launch");
  await page.selectOption(".starter select", "live");
  await page.click(".starter button");
  await stateIs(page, "running");
  await show(page, "primary");
  await until(page, "a car that drives", () => {
    const speed = document.querySelector('[data-path="ego.vx"]');
    return speed?.dataset.quality === "fresh" && Number(speed.textContent.match(/\d+/)) > 20;
  });
  assert.match(await page.textContent(".mode-word"), /HIL/);
  assert.match(await page.textContent(".link-tile .word"), /GOOD|DEGRADED/);
  await show(page, "hil");
  assert.match(await page.textContent(".hil-page"), /live, seed 11/);
  await page.click('.run button:has-text("Stop")');
  await stateIs(page, "stopped");
  assert.deepEqual(faults, []);
});
