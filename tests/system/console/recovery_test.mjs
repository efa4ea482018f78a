/**
 * A whole run by the console alone: the unmodified car program drives on the bench, is stopped at
 * the console, says why it stands, is released, acknowledged, reset and armed there, and drives on.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { kRoot } from "./packages.mjs";
import { attachCar, saidBy } from "./attached_car.mjs";
import { baseStage, hold, kScreenshots, until as waitFor } from "./stage.mjs";

const kLengthS = 300;
const kTries = 5;
const kTryAgainMs = 1500;
const kFastMph = 25;

const stage = baseStage({ car: false });

const speedAbove = (mph) => {
  const value = document.querySelector('.primary [data-path="ego.vx"]');
  return (
    value?.dataset.quality === "fresh" && Number(value.querySelector(".digits").textContent) > mph
  );
};
const modeIs = (word) => document.querySelector(".car-state .digits").textContent === word;
const stepIs = ([step, standing]) =>
  document.querySelector(`.stop-card [data-step="${step}"]`)?.dataset.standing === standing;
const button = (step) => `.stop-card [data-step="${step}"] button`;

/** The scenario `launch`, long enough for a stop and the way back. */
function longLaunch({ folder }) {
  const launch = readFileSync(join(kRoot, "hil/scenarios/launch.yaml"), "utf8");
  const path = join(folder, "launch.yaml");
  writeFileSync(path, launch.replace(/^duration_s: \d+$/m, `duration_s: ${kLengthS}`));
  return path;
}

/** What the page and the programs say, for a test that waits in vain. */
async function told(page) {
  const card = await page.$$eval(".stop-card, .ladder", (all) => all.map((e) => e.innerText));
  const audit = await page.evaluate(() =>
    globalThis.pitwall.session.audit.value.map((line) => `${line.what}: ${line.result}`),
  );
  const known = await page.evaluate(() => {
    const { session } = globalThis.pitwall;
    const fields = session.fields.value;
    const value = (path) => `${path} ${fields.value[fields.slot(path)]}`;
    return [
      JSON.stringify(session.stopState.value),
      ...["mode.arming", "faults.now", "faults.now_more", "faults.last_cause"].map(value),
    ];
  });
  return [...card, ...audit, ...known, saidBy(stage.programs).slice(-2000)].join("\n");
}

test("stop with its cause, release, acknowledge, reset, arm, drive on", async () => {
  const { programs } = stage;
  await attachCar(programs, longLaunch(programs), kLengthS);
  const { page, faults } = await stage.open();
  const until = (...what) =>
    waitFor(page, ...what).catch(async (error) => {
      throw new Error(`${error.message}\n${await told(page)}`);
    });
  const shoot = (name) => page.screenshot({ path: join(kScreenshots, `recovery_${name}.png`) });
  await until("a car that drives", speedAbove, kFastMph);
  assert.equal(await page.locator(".stop-card").count(), 0);

  await page.click("button.stop.controlled");
  await until("the card", () => document.querySelector(".stop-card"));
  await until("the cause", () =>
    /operator/.test(document.querySelector(".stop-card .cause").textContent),
  );
  const said = await page.innerText(".stop-card");
  assert.match(said, /CONTROLLED STOP/);
  assert.match(said, /latched by\s+console \d+/);
  assert.match(said, /\d\d:\d\d:\d\d UTC/);
  await shoot("stopping");
  assert.equal(await page.isDisabled(button("release")), true, "a car that moves is not released");
  await page.click('.stop-card button:has-text("Take the authority")');
  await until("a car that stands", stepIs, ["release", "possible"]);
  await shoot("standing");
  assert.equal(await page.isDisabled(button("arm")), true);
  await hold(page, button("release"), 900);
  await until("released", stepIs, ["release", "done"]);
  await page.click(button("acknowledge"));
  await until("acknowledged", stepIs, ["acknowledge", "done"]);
  await until("a way to reset", stepIs, ["reset", "possible"]);
  await page.click(button("reset"));
  await until("reset", stepIs, ["reset", "done"]);
  await until("a way to arm", stepIs, ["arm", "possible"]);
  await shoot("to_arm");
  // The drive-by-wire brakes by itself until it knows that nobody drives: barred for a moment.
  for (let n = 0; n < kTries && (await page.locator(".stop-card").count()) > 0; ++n) {
    await page.click(button("arm"));
    await page.waitForTimeout(kTryAgainMs);
  }
  await until("no stop any more", () => !document.querySelector(".stop-card"));
  await until("driving", modeIs, "driving");
  await until("a car that drives on", speedAbove, kFastMph);
  await shoot("drives_on");
  const audit = await page.evaluate(() =>
    globalThis.pitwall.session.audit.value.map((line) => `${line.what}: ${line.result}`),
  );
  for (const what of [/controlled stop/, /release stop/, /reset/, /arm/]) {
    assert.ok(
      audit.some((line) => what.test(line)),
      `${what} is audited:\n${audit.join("\n")}`,
    );
  }
  assert.deepEqual(faults, []);
});
