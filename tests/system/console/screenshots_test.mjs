/**
 * Every page in every theme, as a picture in build/console/screenshots, with a race situation in
 * it; nothing may be written to the browser's console meanwhile, and nothing asked for elsewhere.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Double } from "./double.mjs";
import { kPages, kScreenshots, kSizes, kThemes, launch, open } from "./stage.mjs";
import { greetings, troubles } from "./story.mjs";

let browser;
let double;
let address;

before(async () => {
  browser = await launch();
  double = new Double();
  double.greetings = greetings(double);
  troubles(double);
  address = await double.listen();
});

after(async () => {
  await browser?.close();
  await double?.close();
});

for (const theme of kThemes) {
  test(`every page in the ${theme} theme`, async () => {
    const { page, faults, context } = await open(browser, address, { theme });
    await page.waitForTimeout(2500);
    for (const name of kPages) {
      await page.evaluate((hash) => (location.hash = hash), `#/${name}`);
      await page.waitForTimeout(600);
      await page.screenshot({
        path: join(kScreenshots, `${name}_${theme}.png`),
      });
    }
    assert.deepEqual(faults, []);
    await context.close();
  });
}

test("the primary page at each size", async () => {
  for (const size of kSizes) {
    const { page, faults, context } = await open(browser, address, { size });
    await page.waitForTimeout(1500);
    await page.screenshot({
      path: join(kScreenshots, `primary_${size.join("x")}.png`),
    });
    assert.deepEqual(faults, []);
    await context.close();
  }
});

test("the primary page in each world, held in the past, and with a silent car", async () => {
  const shoot = (page, name) => page.screenshot({ path: join(kScreenshots, `world_${name}.png`) });
  const size = [1280, 800];
  for (const mode of ["REAL", "REPLAY", "NONE"]) {
    double.hello.mode = mode;
    const { page, context } = await open(browser, address, { size });
    await page.waitForTimeout(1200);
    await shoot(page, mode.toLowerCase());
    await context.close();
  }
  double.hello.mode = "HIL";
  const { page, context } = await open(browser, address, { size });
  await page.waitForTimeout(2500);
  await page.keyboard.press("ArrowLeft");
  await page.waitForTimeout(500);
  await shoot(page, "held");
  await page.keyboard.press("l");
  await page.keyboard.press("?");
  await page.waitForTimeout(300);
  await shoot(page, "keys");
  await page.keyboard.press("?");
  double.silence();
  await page.waitForTimeout(4000);
  await shoot(page, "silent");
  await context.close();
});
