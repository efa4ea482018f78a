/**
 * The console on the real base, with a car's real end of the radio behind it: live within a second,
 * stale everywhere when the car is killed, stops that reach the car, the base killed and started
 * again.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { kPatienceMs } from "./client.mjs";
import { baseStage, escapeTwice, hold, kPages, show, until } from "./stage.mjs";

const kBareDocumentMs = 150;

const stage = baseStage();

/** Fields of the car that are drawn as if they were known, on a page on which none should be. */
const carAlive = () =>
  [...document.querySelectorAll(".value[data-path]")]
    .filter((e) => !/^(link|derived|base|radio)\./.test(e.dataset.path))
    .filter(
      (e) =>
        ["fresh", "late"].includes(e.dataset.quality) ||
        !["none", undefined].includes(e.dataset.judgement),
    )
    .map((e) => `${e.dataset.path} ${e.dataset.quality} ${e.dataset.judgement}`);

test("the live car, its mode and its link are shown, every page without a fault", async () => {
  const { page, faults } = await stage.open();
  await until(
    page,
    "50.5 m/s in mph",
    () => document.querySelector('[data-path="ego.vx"] .digits').textContent === "113",
  );
  await until(page, "the link's state", () =>
    /GOOD|DEGRADED/.test(document.querySelector(".link-tile .word").textContent),
  );
  assert.notEqual(await page.textContent(".mode-word strong"), "NO BASE");
  for (const name of kPages) {
    await show(page, name);
    await page.waitForTimeout(400);
  }
  assert.deepEqual(faults, []);
  const counters = await page.evaluate(() => globalThis.pitwall.session.counters);
  assert.equal(counters.badFrames, 0);
  assert.equal(counters.badTexts, 0);
  assert.equal(await page.evaluate(() => globalThis.pitwall.session.fields.value.unknownIds), 0);
});

/** In the page: when, on its own clock, the car's speed, its flags and its link were all drawn. */
const noteFirst = () => {
  const word = (selector) => document.querySelector(selector)?.textContent ?? "";
  const look = () => {
    const speed = document.querySelector('[data-path="ego.vx"][data-quality="fresh"] .digits');
    const known =
      speed?.textContent === "113" &&
      word('.flag[data-path="flags.track"][data-flag="green"] .digits') === "GREEN" &&
      word('.flag[data-path="flags.vehicle"] .digits') === "ATTACKER" &&
      /GOOD|DEGRADED/.test(word(".link-tile .word"));
    if (known) globalThis.firstMs = performance.now();
    else requestAnimationFrame(look);
  };
  look();
};

test("within a second of loading: the live car, its flags and its link", async (t) => {
  const { page, context } = await stage.open();
  await until(page, "a link", () =>
    /GOOD|DEGRADED/.test(document.querySelector(".link-tile .word").textContent),
  );
  const tries = [];
  for (let n = 0; n < 3; ++n) {
    const fresh = await context.newPage();
    await fresh.goto(`${stage.address}/api/catalogue`);
    const bareMs = await fresh.evaluate(() => performance.now());
    await fresh.addInitScript(noteFirst);
    await fresh.goto(`${stage.address}/`);
    await until(fresh, "car, flags and link", () => globalThis.firstMs);
    tries.push({ bareMs, firstMs: await fresh.evaluate(() => globalThis.firstMs) });
    await fresh.close();
  }
  const best = tries.sort((a, b) => a.firstMs - b.firstMs)[0];
  t.diagnostic(`${best.firstMs.toFixed(0)} ms, a bare document ${best.bareMs.toFixed(0)} ms`);
  // A machine on which a document without scripts takes so long is not one to judge a second on.
  const slowness = Math.max(1, best.bareMs / kBareDocumentMs);
  assert.ok(best.firstMs <= 1000 * slowness, JSON.stringify(tries));
});

test("nothing outside this machine is needed", () => {
  const routes = readFileSync("/proc/net/route", "utf8").trim().split("\n").slice(1);
  const out = routes.filter((route) => !route.startsWith("lo\t"));
  assert.deepEqual(out, [], "the tests of this file run where no route leads out");
});

test("a layout that is none is told of, and the page is drawn as usual", async () => {
  const keep = (name, text) => writeFileSync(join(stage.programs.folder, "layouts", name), text);
  keep("primary.json", '{"columns": 7}');
  const { page, context } = await stage.open();
  const refused = (wanted) => document.querySelector(".refused")?.textContent.includes(wanted);
  await until(page, "what is wrong", refused, "not valid; the default is shown (layout primary)");
  assert.equal(await page.locator(".primary .panel").count(), 9);
  await context.close();
  keep("primary.json", '{"columns": [{"share": 1, "panels": ["map"]}]}');
  keep("plots.json", "{");
  const { page: next } = await stage.open();
  await until(next, "what is wrong", refused, "not JSON; the default is shown (layout plots)");
  assert.equal(await next.locator(".primary .panel").count(), 1);
});

test("the track of the base is drawn", async () => {
  const { page } = await stage.open();
  await until(
    page,
    "the track's name",
    () => document.querySelector(".map-caption").firstChild.textContent === "LVMS",
  );
});

test("the car is killed: every field of it stale, none coloured, on every page", async () => {
  const { page } = await stage.open();
  await stage.programs.kill("car");
  for (const name of kPages) {
    await show(page, name);
    await page.waitForTimeout(400);
    let alive = ["not looked at"];
    for (const end = Date.now() + kPatienceMs; alive.length > 0 && Date.now() < end;) {
      alive = await page.evaluate(carAlive);
      await page.waitForTimeout(100);
    }
    assert.deepEqual(alive, [], name);
  }
  await show(page, "primary");
  await until(page, "the last speed, struck", () => {
    const value = document.querySelector('.primary [data-path="ego.vx"]');
    return (
      value?.dataset.quality === "stale" && value.querySelector(".digits").textContent === "113"
    );
  });
  assert.match(await page.textContent(".link-tile .word"), /LOST/);
});

test("a stop reaches the car, and the console says what the car says", async () => {
  const { page } = await stage.open();
  await escapeTwice(page);
  await until(
    page,
    "the car's own word",
    () => document.querySelector(".outcome").textContent === "car: controlled stop",
  );
  await stage.programs.carHas("stop 1");
});

test("a command climbs its ladder, or its gates say why not", async () => {
  const { page } = await stage.open({ hash: "#/commands" });
  await page.click("text=Take authority");
  await until(
    page,
    "the authority",
    () => document.querySelector(".holder").dataset.mine === "true",
  );
  await page.selectOption('select[aria-label="command"]', "speed limit");
  await page.fill('input[aria-label="argument"]', "120");
  await page.click(".stage button[type=submit]");
  await until(page, "gates", () => document.querySelector(".staged .gate"));
  // Nothing is known of this car's flags and tyres: such a car gets no speed.
  assert.ok((await page.locator('.gate[data-ok="false"]').count()) > 0);
  assert.equal(await page.isDisabled("button.send"), true);
  await page.click(".staged >> text=Cancel");
  // Less than now may be driven under it, so that every gate lets it pass.
  await page.selectOption('select[aria-label="command"]', "track flag");
  await page.click('.choice:has-text("RED")');
  await page.click(".stage button[type=submit]");
  await until(page, "a way to send", () =>
    document.querySelector(".staged button.send:not(:disabled)"),
  );
  await hold(page, ".staged button.send", 1200);
  await until(page, "applied by the car", () =>
    [...document.querySelectorAll(".ladder > li")].some(
      (li) =>
        li.textContent.includes("track flag RED") &&
        li.querySelector(".rungs li:nth-child(5)").dataset.reached === "true",
    ),
  );
  await stage.programs.carHas("command track flag 1");
});

test("the base is killed and started again: the console finds it, a layout is kept", async () => {
  const { page } = await stage.open();
  await page.focus(".panel-fuel");
  await page.keyboard.press("Alt+ArrowUp");
  await page.waitForTimeout(400);
  await stage.programs.kill("base");
  await until(page, "NO BASE", () =>
    document.querySelector(".link-tile .word").textContent.startsWith("NO BASE"),
  );
  await stage.programs.startBase();
  await until(
    page,
    "fresh values",
    () => document.querySelector('[data-path="ego.vx"]').dataset.quality === "fresh",
  );
  await page.reload();
  await until(
    page,
    "the layout",
    () =>
      [...document.querySelectorAll(".primary .panel")].findIndex((p) =>
        p.classList.contains("panel-fuel"),
      ) === 2,
  );
});
