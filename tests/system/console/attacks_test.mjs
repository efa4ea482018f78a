/**
 * Attacks and key errors on the console of the real base: each an alarm with what to do about it
 * within two seconds, a car of ours or none, and one line of the base's log, whatever the rate.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createSocket } from "node:dgram";
import { join } from "node:path";
import { test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import { kBase } from "./programs.mjs";
import { baseStage, kScreenshots, until } from "./stage.mjs";

const kFloodMs = 3000;
const kBurst = 200;
const kPauseMs = 5;

const stage = baseStage({ car: false });

/** Opens the page of the alarms on a base that no car was heard at yet. */
async function openAlarms() {
  const { page } = await stage.open({ hash: "#/alarms", ready: ".alarm-line" });
  assert.equal(await page.textContent(".alarm-line .text"), "no alarms");
  return page;
}

const alarmIs = (page, text) =>
  until(
    page,
    `alarm "${text}"`,
    (wanted) => document.querySelector(".alarm-line .text").textContent === wanted,
    text,
  );

const linesOfLog = (what) => stage.programs.baseSaid.split("\n").filter((l) => l.includes(what));

test("a car with another key: an alarm, though there is no link and never was", async () => {
  const page = await openAlarms();
  execFileSync(kBase, ["keygen", "--out", join(stage.programs.folder, "other")]);
  stage.programs.startCar(30, "other/car.keys");
  await alarmIs(page, "Key exchange messages do not fit our keys");
  assert.match(await page.textContent(".alarms-page .alarm .response"), /^No link: copy both key/);
  await page.screenshot({ path: join(kScreenshots, "alarm_wrong_key.png") });
  await sleep(kFloodMs);
  assert.equal(await page.locator(".alarms-page .alarm").count(), 1);
  assert.deepEqual(linesOfLog("radio, seen by"), [
    "pitwall-base: CAR 0: radio, seen by the base: Key exchange messages do not fit our keys",
  ]);
});

test("a flood beside our car: one alarm, one line, and the link is good", async () => {
  const page = await openAlarms();
  stage.programs.startCar();
  await until(page, "the link", () =>
    /GOOD/.test(document.querySelector(".link-tile .word").textContent),
  );
  const [host, port] = stage.programs.radio.split(":");
  const socket = createSocket("udp4");
  const noise = Buffer.alloc(60, 0xff);
  let over = false;
  const flood = async () => {
    for (; !over; await sleep(kPauseMs)) {
      for (let i = 0; i < kBurst; ++i) socket.send(noise, Number(port), host);
    }
  };
  const flooding = flood();
  await alarmIs(page, "Forged or foreign datagrams come at rate; all are refused");
  await sleep(kFloodMs);
  over = true;
  await flooding;
  socket.close();
  assert.match(await page.textContent(".link-tile .word"), /GOOD/);
  assert.equal(await page.locator(".alarms-page .alarm").count(), 1);
  assert.equal(linesOfLog("radio, seen by").length, 1);
  const warnings = await page.evaluate(() =>
    globalThis.pitwall.session.carEvents.value
      .filter((event) => event.severity === "warning")
      .map((event) => event.text),
  );
  assert.deepEqual(warnings, [linesOfLog("radio, seen by")[0].split("CAR 0: ")[1]]);
});
