/**
 * A base that binds tokens, and a browser: nothing is shown before somebody has logged in, the
 * token stands in no address and no script's reach, and a wrong one says so.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { baseStage, kScreenshots, until } from "./stage.mjs";

const kToken = "anna-4f1c9a7be2d05586";
const kFresh = '.value[data-quality="fresh"]';

const stage = baseStage({
  flags: ({ folder }) => {
    const tokens = join(folder, "tokens");
    writeFileSync(tokens, `operator ${kToken} Anna\n`, { mode: 0o600 });
    return ["--web-tokens", tokens];
  },
});

async function logIn(page, token) {
  await page.fill('.login input[name="token"]', token);
  await page.click('.login button[type="submit"]');
}

test("nothing is shown before somebody has logged in, and everything after it", async () => {
  const { page } = await stage.open({ ready: ".login" });
  const heard = [];
  page.on("websocket", (socket) => socket.on("framereceived", () => heard.push(socket.url())));
  await page.waitForTimeout(1000);
  assert.equal(await page.locator(".frame").count(), 0, "no frame of the console");
  assert.deepEqual(heard, [], "and no word of the base");
  await page.screenshot({ path: join(kScreenshots, "login.png") });
  await logIn(page, "somebody-else-0000000");
  await until(page, "why not", () =>
    document.querySelector('.login [role="alert"]')?.textContent.includes("a token of this base"),
  );
  await logIn(page, ` ${kToken} `);
  await page.waitForSelector(kFresh, { state: "attached" });
  assert.ok(!page.url().includes(kToken), "no token in the address");
  assert.equal(await page.evaluate(() => document.cookie), "", "no script reads the cookie");
  const role = await page.evaluate(() => globalThis.pitwall.session.hello.value.role);
  assert.equal(role, "operator");
  await page.reload();
  await page.waitForSelector(kFresh, { state: "attached" });
  await page.keyboard.press("?");
  await page.click(".logged-in button");
  await page.waitForSelector(".login");
});

test("another start of the base knows who was logged in", async () => {
  const { page } = await stage.open({ ready: ".login" });
  await logIn(page, kToken);
  await page.waitForSelector(kFresh, { state: "attached" });
  await stage.programs.kill("base");
  await until(page, "gone", () => !globalThis.pitwall.session.connected.value);
  await stage.programs.startBase("--web-tokens", join(stage.programs.folder, "tokens"));
  await until(page, "back", () => globalThis.pitwall.session.connected.value);
  assert.equal(await page.locator(".login").count(), 0);
});
