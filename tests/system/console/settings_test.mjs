/**
 * What the holder of the authority enters on the real base: fuel in the tank, the announced round
 * speed, limits, the radio's budget; the alarms by the keyboard and by ear.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { baseStage, hold, show, until } from "./stage.mjs";

const kHeldMs = 800;
let file = "";

const stage = baseStage({
  flags: ({ folder }) => {
    file = join(folder, "wall.yaml");
    return ["--judgement", file];
  },
});

const textOf = (selector) => document.querySelector(selector)?.textContent ?? "";

async function holder() {
  const opened = await stage.open({ hash: "#/commands" });
  await opened.page.click('button:has-text("Take authority")');
  await until(opened.page, "its own", () => document.querySelector('.holder[data-mine="true"]'));
  return opened;
}

async function apply(page, panel, reason) {
  await page.fill(`${panel} .review input`, reason);
  await hold(page, `${panel} .review button`, kHeldMs);
}

test("fuel that was filled in is reckoned with, and called an estimate", async () => {
  const { page, faults } = await holder();
  const said = page.locator('[aria-label="what we know"]');
  await said.locator('label:has-text("fuel") input').fill("40");
  await said.locator('button:has-text("In the tank")').click();
  await said.locator('label:has-text("round speed") input').fill("115");
  await said.locator('button:has-text("Announced")').click();
  await until(page, "both said", () => {
    const text = document.querySelector('[aria-label="what we know"] .who').textContent;
    return text.includes("115 mph") && text.includes("40.0 l");
  });
  await until(
    page,
    "the announced speed in the top bar",
    () =>
      document.querySelector('[data-path="derived.round_speed_expected"] .digits').textContent ===
      "115",
  );
  await show(page, "primary");
  await until(page, "an estimate", () => document.body.textContent.includes("ESTIMATE"));
  await until(
    page,
    "attempts",
    () =>
      Number(document.querySelector('[data-path="derived.fuel_attempts"] .digits').textContent) > 1,
  );
  assert.deepEqual(faults, []);
});

test("limits and the budget are reviewed, held, kept in the file and counted", async () => {
  const { page, faults } = await holder();
  await show(page, "alarms");
  const panel = ".settings";
  await page.selectOption(`${panel} select`, "wheel_slip");
  await page.fill(`${panel} label:has-text("limit") input`, "0.11");
  assert.match(await page.textContent(`${panel} .review li`), /limit: 0.08 \u2192 0.11/);
  assert.equal(await page.isDisabled(`${panel} .review button`), true, "without a reason");
  await apply(page, panel, "new tyres");
  await until(page, "revision 1", () => document.body.textContent.includes("revision 1"));
  await page.selectOption(`${panel} select`, "field electric.battery");
  await page.fill(`${panel} label:has-text("bad low") input`, "10.5");
  await apply(page, panel, "old battery");
  await until(page, "revision 2", () => document.body.textContent.includes("revision 2"));
  await page.fill(`${panel} label:has-text("warning low") input`, "1");
  await apply(page, panel, "a mistake");
  await until(page, "refused", () => document.querySelector(".refused"));
  await page.selectOption(`${panel} select >> nth=0`, "field mode.mode");
  const stopping = `${panel} label:has-text("controlled stop") select`;
  assert.equal(await page.inputValue(stopping), "bad");
  await page.selectOption(stopping, "warning");
  assert.match(await page.textContent(`${panel} .review li`), /stop: bad \u2192 warning/);
  await apply(page, panel, "a planned stop");
  await until(page, "revision 3", () => document.body.textContent.includes("revision 3"));
  await show(page, "link");
  await page.fill('[aria-label="kbit/s up each radio"]', "100");
  await apply(page, '[aria-label="budget"]', "shared radio");
  await until(page, "100 kbit/s", () =>
    document.querySelector('[aria-label="budget"] h2').textContent.includes("100 kbit/s"),
  );
  const kept = readFileSync(file, "utf8");
  for (const line of [
    "revision: 4",
    "warning_values: [3, 6]",
    "a planned stop",
    "up_kbit_s: 100",
    "limit: 0.11",
    "bad_low: 10.5",
    "new tyres",
  ]) {
    assert.ok(kept.includes(line), `${line} in ${kept}`);
  }
  assert.deepEqual(faults, []);
});

test("S shelves for a time and a reason; sound is off until it is wanted", async () => {
  const { page } = await stage.open();
  await page.click("button.sound");
  await until(page, "sound", () => document.querySelector('.sound[data-sound="on"]'));
  await stage.programs.kill("car");
  await until(page, "an alarm", () => document.querySelector(".alarm-line kbd"));
  await until(page, "a tone", () => globalThis.pitwall.sounded.last === "high");
  await page.keyboard.press("s");
  await page.keyboard.type("car is in the garage");
  await page.keyboard.press("Enter");
  await until(page, "shelved", () => globalThis.pitwall.session.alarms.value.shelved.length === 1);
  const [shelved] = await page.evaluate(() => globalThis.pitwall.session.alarms.value.shelved);
  assert.equal(shelved.reason, "car is in the garage");
  assert.equal(await page.evaluate(textOf, '[role="dialog"]'), "");
  await page.click("button.sound");
  await until(page, "muted", () => document.querySelector('.sound[data-sound="muted"]'));
});
