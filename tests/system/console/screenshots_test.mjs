/**
 * Every page in every theme, as a picture in build/console/screenshots, with a race situation in
 * it; nothing may be written to the browser's console meanwhile, and nothing asked for elsewhere.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Double } from "./double.mjs";
import {
  kPages,
  kScreenshots,
  kSizes,
  kThemes,
  launch,
  open,
} from "./stage.mjs";
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
