/**
 * Pages of the bench, opened from the console of somebody who has logged in: those of a real sweep,
 * of its worst case and of a real run. They open beside the console, their scripts work, and reach
 * neither the console nor the base.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { rmSync, symlinkSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { socketOf, startBenchServer, stateIs, sweepRoundSpeed, sweepsOf } from "./bench_server.mjs";
import { baseStage, kScreenshots, until } from "./stage.mjs";

const kToken = "anna-4f1c9a7be2d05586";

const stage = baseStage({
  car: false,
  flags: (programs) => {
    startBenchServer(programs);
    const tokens = join(programs.folder, "tokens");
    writeFileSync(tokens, `viewer ${kToken} Anna\noperator operator-of-the-bench Bo\n`, {
      mode: 0o600,
    });
    return ["--bench", socketOf(programs), "--web-tokens", tokens];
  },
});

/** The HIL page, with what any page says that is opened from it. */
async function openHil(token) {
  const { page, context } = await stage.open({ hash: "#/hil", ready: ".login" });
  await page.fill('.login input[name="token"]', token);
  await page.click('.login button[type="submit"]');
  await page.waitForSelector(".scenarios li");
  const faults = [];
  context.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) faults.push(message.text());
  });
  context.on("weberror", (error) => faults.push(String(error.error())));
  context.on("request", (request) => {
    if (!request.url().startsWith(stage.address)) faults.push(`elsewhere: ${request.url()}`);
  });
  return { page, context, faults };
}

async function clickOpens(page, selector) {
  const [opened] = await Promise.all([page.context().waitForEvent("page"), page.click(selector)]);
  await opened.waitForLoadState();
  return opened;
}

/** In the page: what it can reach of the base and of the console. */
const reach = async () => {
  const attempt = async (what) => {
    try {
      return await what();
    } catch {
      return "refused";
    }
  };
  return {
    origin: globalThis.origin,
    opener: globalThis.opener,
    cookie: await attempt(() => document.cookie),
    storage: await attempt(() => localStorage.length),
    base: await attempt(async () => (await fetch("/api/session")).status),
    frame: await attempt(() => {
      const frame = document.createElement("iframe");
      frame.src = "/";
      document.body.append(frame);
      return frame.contentDocument === null ? "refused" : "read";
    }),
  };
};
const kNothing = {
  origin: "null",
  opener: null,
  cookie: "refused",
  storage: "refused",
  base: "refused",
  frame: "refused",
};

test("a click opens the page of a sweep, and a link in it that of its worst case", async () => {
  sweepRoundSpeed(stage.programs);
  const { page, faults } = await openHil(kToken);
  await page.waitForSelector(".sweeps a");
  await page.screenshot({ path: join(kScreenshots, "bench_sweeps.png") });
  assert.equal(await page.textContent(".sweeps a"), "round_speed");
  assert.match(await page.getAttribute(".sweeps a", "title"), /round_speed\/report\.html$/);
  const opened = await clickOpens(page, ".sweeps a");
  assert.match(await opened.title(), /round_speed/);
  await opened.setViewportSize({ width: 1280, height: 800 });
  await opened.screenshot({ path: join(kScreenshots, "bench_page_of_sweep.png") });
  await opened.click('a[href^="pages/"]');
  await opened.waitForURL(/sweeps\/round_speed\/pages\/0\/report\.html$/);
  await opened.waitForSelector("svg.time");
  await opened.hover("svg.time >> nth=0");
  await until(opened, "the value under the pointer", () =>
    /\d s/.test(document.querySelector("svg.time .read").textContent),
  );
  await opened.screenshot({ path: join(kScreenshots, "bench_page_of_case.png") });
  assert.match(page.url(), /#\/hil$/, "the console is where it was");
  assert.ok(await page.isVisible(".sweeps a"));
  assert.deepEqual(faults, []);
  assert.deepEqual(await opened.evaluate(reach), kNothing);
});

test("a click opens the page of a run that has ended", async () => {
  const { page, faults } = await openHil("operator-of-the-bench");
  await page.fill(".chooser .filter", "launch");
  await page.click(".starter button");
  await stateIs(page, "passed");
  assert.match(await page.getAttribute(".run .files a", "title"), /runs\/1\/report\.html$/);
  await page.screenshot({ path: join(kScreenshots, "bench_run.png") });
  const opened = await clickOpens(page, ".run .files a");
  assert.match(await opened.title(), /launch_and_stop/);
  assert.ok((await opened.locator("svg.time").count()) > 3);
  assert.ok(
    await page.isVisible(".stop-rail .stop.controlled"),
    "and the stops are at the console",
  );
  assert.deepEqual(faults, []);
});

test("a page that is gone, leads elsewhere or is for others is refused with a reason", async () => {
  const { page, context } = await openHil(kToken);
  const status = async (path) => {
    const answer = await context.request.get(`${stage.address}/bench/${path}`);
    return [answer.status(), (await answer.text()).replace(/^page [^ ]*: error: /, "").trim()];
  };
  const car = await page.evaluate(() => globalThis.pitwall.session.hello.value.car);
  const sweeps = sweepsOf(stage.programs);
  assert.deepEqual(await status(`${car}/sweeps/grip/report.html`), [404, "no such page"]);
  writeFileSync(join(sweeps, "grip/report.html"), "<title>grip</title>");
  assert.equal((await status(`${car}/sweeps/grip/report.html`))[0], 200);
  symlinkSync("/etc/hostname", join(sweeps, "grip/host.html"));
  const [code, why] = await status(`${car}/sweeps/grip/host.html`);
  assert.deepEqual([code, why], [404, "leads out of the folder of the pages"]);
  for (const path of [
    "sweeps/grip/summary.json",
    "sweeps/grip/%2e%2e%2fx.html",
    "scenarios/x.html",
  ])
    assert.match((await status(`${car}/${path}`)).join(" "), /^404 expected runs\/NAME/, path);
  assert.match((await status("99/sweeps/grip/report.html")).join(" "), /^404 this base has no car/);
  await stage.programs.kill("bench");
  await until(page, "no server", () => document.querySelector('.hil-page[data-up="false"]'));
  assert.deepEqual(await status(`${car}/sweeps/grip/report.html`), [
    503,
    "the bench server is not there",
  ]);
  assert.equal(await page.locator(".sweeps a").count(), 0, "no link to what nobody serves");
  await context.request.delete(`${stage.address}/api/session`);
  assert.equal((await status(`${car}/sweeps/grip/report.html`))[0], 401, "who has logged out");
  rmSync(join(sweeps, "grip"), { recursive: true });
});
