/**
 * Two cars on one base: each has its own link, authority, alarms, recording and tab; what is said
 * on the console of one is never the other's, but a stop of all stops all, and the map shows all;
 * one that falls silent leaves the other as it was; and
 * a car that speaks with its own keys at the other's radio is not heard there.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Client } from "../console/client.mjs";
import { kAxe, WebSocket } from "../console/packages.mjs";
import {
  hold,
  kPages,
  kScreenshots,
  kThemes,
  launch,
  open,
  show,
  until,
} from "../console/stage.mjs";
import { kNames, TwoPrograms } from "./two_programs.mjs";

const kPatienceMs = 20_000;
const kAllPages = kPages;

let browser, programs, address, page, faults, clients;

before(async () => {
  programs = new TwoPrograms();
  [browser, address] = await Promise.all([launch(), programs.startBase()]);
  programs.startCar(7);
  programs.startCar(8);
  ({ page, faults } = await open(browser, address, { size: [1280, 800] }));
  clients = {
    7: await Client.open(address, new Client(), "?car=7"),
    8: await Client.open(address, new Client(), "?car=8"),
  };
  await until(
    page,
    "both links",
    () => {
      const words = [...document.querySelectorAll(".car-tab .tab-link .word")];
      return words.length === 2 && words.every((word) => /GOOD|DEGRADED/.test(word.textContent));
    },
    undefined,
    kPatienceMs,
  );
});
after(async () => {
  await programs.close();
  await browser.close();
});

const shown = () => globalThis.pitwall.session.shownCar.value.number;
const tab = (number) => page.locator(`.car-tab[data-car="${number}"]`);
const speedOf = () => document.querySelector('[data-path="ego.vx"]').dataset.quality;

test("the base says which cars it has, and has no others", async () => {
  const { cars } = await (await fetch(`${address}/api/cars`)).json();
  assert.deepEqual(
    cars.map(({ number, name }) => [number, name]),
    Object.entries(kNames).map(([number, name]) => [Number(number), name]),
  );
  assert.equal((await fetch(`${address}/api/track?car=8`)).status, 200);
  assert.equal((await fetch(`${address}/api/track?car=9`)).status, 404);
  const stranger = new WebSocket(`${address.replace("http", "ws")}/ws?car=9`);
  const [refused] = await new Promise((done) => {
    stranger.on("unexpected-response", (_, response) => done([response.statusCode]));
    stranger.on("open", () => done([101]));
    stranger.on("error", () => {});
  });
  assert.equal(refused, 404);
  assert.equal(clients[7].newest.hello.car, 7);
  assert.equal(clients[8].newest.hello.car, 8);
});

test("every page says whose it is, and showing the other keeps the page", async () => {
  for (const name of kAllPages) {
    await show(page, name);
    for (const number of [8, 7]) {
      await tab(number).click();
      await until(
        page,
        `car ${number} on ${name}`,
        ([wanted, title, hash]) =>
          document.querySelector(".mode-word strong").textContent.endsWith(` ${wanted}`) &&
          document.querySelector(".mode-word").textContent.includes(title) &&
          document.querySelector(".stop.controlled strong").textContent === `STOP ${wanted}` &&
          document.querySelector(".stop.emergency strong").textContent.endsWith(` ${wanted}`) &&
          document.querySelector(".stop-rail .car-chip").textContent === String(wanted) &&
          document.querySelector(".car-tab[aria-current]").dataset.car === String(wanted) &&
          location.hash === hash,
        [number, kNames[number], `#/${name}`],
      );
    }
  }
  assert.match(page.url(), /[?&]car=7/);
  await page.keyboard.press("c");
  assert.equal(await page.evaluate(shown), 8);
  await page.keyboard.press("c");
  assert.equal(await page.evaluate(shown), 7);
  assert.deepEqual(faults, []);
});

test("an address with a car opens that car, and one of no car here the first", async () => {
  const second = await open(browser, address, { hash: "?car=8#/link" });
  assert.equal(await second.page.evaluate(shown), 8);
  await second.context.close();
  const nobody = await open(browser, address, { hash: "?car=9#/link" });
  assert.equal(await nobody.page.evaluate(shown), 7);
  assert.doesNotMatch(nobody.page.url(), /car=9/);
  await nobody.context.close();
});

test("authority over one car is none over the other", async () => {
  clients[7].say({ type: "authority", do: "take" });
  const mine = clients[7].newest.hello.client;
  await clients[7].until("authority of car 7", () => clients[7].newest.authority?.holder === mine);
  assert.equal(clients[8].newest.authority.holder, 0);
  clients[8].say({ type: "stage", name: "speed_limit", argument: 20 });
  await clients[8].until("a refusal", () => clients[8].newest.error);
  assert.equal(clients[7].count("error"), 0);
  assert.equal(clients[7].count("command"), 0);
});

test("a stop stops the car that stands on it, and no other", async () => {
  await tab(8).click();
  await page.click(".stop.controlled");
  await clients[8].until("car 8 to be told", () => /stop 1/.test(programs.carSaid[8]));
  await show(page, "primary");
  await hold(page, ".stop.emergency", 700);
  await clients[8].until("car 8 to be told", () => /stop 2/.test(programs.carSaid[8]));
  assert.equal(programs.carSaid[7], "");
  assert.equal(clients[7].texts.filter((t) => t.type === "audit" && /stop/.test(t.what)).length, 0);
});

test("a stop of all stops each, without authority, and each has its line of audit", async () => {
  const audited = (number) =>
    clients[number].texts.filter((t) => t.type === "audit" && /stop/.test(t.what));
  const before = { 7: audited(7).length, 8: audited(8).length };
  await page.click(".stop.all");
  for (const number of [7, 8]) {
    await clients[number].until(
      `a line of car ${number}`,
      () => audited(number).length > before[number],
    );
    assert.equal(audited(number).at(-1).what, "controlled stop");
  }
  await clients[7].until("car 7 to be told", () => /stop 1/.test(programs.carSaid[7]));
  assert.equal(programs.carSaid[7].match(/stop/g).length, 1, "and only once");
});

test("the map of one car shows the other, each in its place", async () => {
  await show(page, "primary");
  await until(
    page,
    "the other car",
    () => {
      const { cars, shownCar } = globalThis.pitwall.session;
      return cars.value.every((car) => car.track.value?.name === shownCar.value.track.value?.name);
    },
    undefined,
    kPatienceMs,
  );
  await page.evaluate(() => {
    globalThis.drawn = new Set();
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
      globalThis.drawn.add(text);
      return fillText.call(this, text, ...rest);
    };
  });
  for (const [shownOne, other] of [
    [8, 7],
    [7, 8],
  ]) {
    await tab(shownOne).click();
    await page.evaluate(() => globalThis.drawn.clear());
    await until(page, `car ${other}`, (name) => globalThis.drawn.has(name), `car ${other}`);
    assert.equal(
      await page.evaluate((name) => globalThis.drawn.has(name), `car ${shownOne}`),
      false,
    );
  }
});

test("alarms are of one car, and its tab tells them on the other's page", async () => {
  await tab(7).click();
  await until(
    page,
    "the stop's alarm in the tab of car 8",
    () => document.querySelector('.car-tab[data-car="8"]').dataset.alarmed === "true",
    undefined,
    kPatienceMs,
  );
  const keys = (number) => clients[number].newest.alarms.active.map((alarm) => alarm.key);
  const mine = keys(8).filter((key) => /stop/.test(key));
  assert.notEqual(mine.length, 0, keys(8).join());
  assert.deepEqual(
    keys(7).filter((key) => mine.includes(key)),
    [],
  );
});

test("in every theme axe finds nothing serious in the tabs", async () => {
  await page.evaluate(kAxe);
  for (const theme of kThemes) {
    await page.evaluate((name) => (document.documentElement.dataset.theme = name), theme);
    await page.waitForTimeout(100);
    const found = await page.evaluate(async () =>
      (await globalThis.axe.run(document, { resultTypes: ["violations"] })).violations
        .filter(({ impact }) => ["serious", "critical"].includes(impact))
        .map(({ id, nodes }) => `${id}: ${nodes.map((n) => n.target).join(" ")}`),
    );
    assert.deepEqual(found, [], theme);
  }
  await page.evaluate(() => (document.documentElement.dataset.theme = "dark"));
});

for (const [width, height] of [
  [1920, 1080],
  [1280, 800],
]) {
  test(`the tabs and the primary page fit ${width} x ${height}`, async () => {
    await page.setViewportSize({ width, height });
    for (const name of ["primary", "plots", "commands"]) {
      await show(page, name);
      await page.waitForTimeout(500);
      await page.screenshot({ path: join(kScreenshots, `two_cars_${name}_${width}.png`) });
    }
    await show(page, "primary");
    await page.waitForTimeout(300);
    const cut = await page.evaluate(() =>
      [...document.querySelectorAll(".primary, .primary .panel, .car-tabs, .car-tab, body")]
        .filter((e) => e.scrollHeight > e.clientHeight + 1 || e.scrollWidth > e.clientWidth + 1)
        .map((e) => `${e.className || e.tagName} ${e.scrollWidth}x${e.scrollHeight}`),
    );
    assert.deepEqual(cut, []);
  });
}

test("the plots show the other car in the same chart", async () => {
  await show(page, "plots");
  await page.selectOption(".plots .tools label:has-text('beside') select", "8");
  await until(
    page,
    "car 8 beside the speed",
    () =>
      [...document.querySelectorAll(".chart .read-outs li")].filter(
        (e) => /car 8/.test(e.textContent) && /\d/.test(e.lastElementChild.textContent),
      ).length > 0,
    undefined,
    kPatienceMs,
  );
  await page.screenshot({ path: join(kScreenshots, "two_cars_beside.png") });
});

test("a car that speaks at the other's radio is not heard there", async () => {
  const before = clients[8].newest.hello;
  programs.startCar(7, { at: 8, as: "stray" });
  await page.waitForTimeout(2000);
  await programs.killCar("stray");
  assert.deepEqual(clients[8].newest.hello, before);
  assert.equal(clients[8].newest.link.state === "lost", false);
});

test("one car's radio dies: its page is stale, the other's untouched", async () => {
  await tab(8).click();
  await show(page, "primary");
  await until(page, "car 8 fresh", () =>
    ["fresh", "late"].includes(document.querySelector('[data-path="ego.vx"]').dataset.quality),
  );
  await page.evaluate(() => {
    // A page to which nothing comes is right to call it stale: it has no processor, or the base.
    const kGapMs = 200;
    const kDrawnAgainMs = 1000;
    globalThis.seen = new Set();
    let known = 0;
    let heardMs = -Infinity;
    let steadyFromMs = 0;
    const watch = (nowMs) => {
      const { frames } = globalThis.pitwall.session.counters;
      if (nowMs - heardMs > kGapMs) steadyFromMs = nowMs + kDrawnAgainMs;
      if (frames !== known) heardMs = nowMs;
      known = frames;
      const { quality } = document.querySelector('[data-path="ego.vx"]').dataset;
      if (nowMs > steadyFromMs) globalThis.seen.add(quality);
      requestAnimationFrame(watch);
    };
    requestAnimationFrame(watch);
  });
  await programs.killCar(7);
  await until(
    page,
    "LOST in the tab of car 7",
    () => /^LOST/.test(document.querySelector('.car-tab[data-car="7"] .word').textContent),
    undefined,
    kPatienceMs,
  );
  await until(page, "a steady view", () => globalThis.seen.size > 0, undefined, kPatienceMs);
  const seen = await page.evaluate(() => [...globalThis.seen]);
  assert.deepEqual(
    seen.filter((quality) => !["fresh", "late"].includes(quality)),
    [],
  );
  assert.match(await tab(8).locator(".tab-link .word").textContent(), /GOOD|DEGRADED/);
  await page.screenshot({ path: join(kScreenshots, "two_cars_one_lost.png") });
  await tab(7).click();
  await until(page, "stale values of car 7", () =>
    ["stale", "never"].includes(document.querySelector('[data-path="ego.vx"]').dataset.quality),
  );
  assert.notEqual(await page.evaluate(speedOf), "fresh");
});

test("each has its own recording and summary, and refused what was not its own", async () => {
  assert.deepEqual(faults, []);
  const summaries = await programs.summaries();
  assert.ok(summaries[7].packets > 100, `${summaries[7].packets}`);
  assert.ok(summaries[8].packets > summaries[7].packets, "car 7 was killed before");
  assert.equal(summaries[7].refused, 0);
  assert.ok(summaries[8].refused > 0, "what the stray car 7 said");
  for (const number of [7, 8]) {
    const segments = readdirSync(join(programs.folder, String(number), "recording"));
    assert.ok(
      segments.some((name) => name.endsWith(".mcap")),
      segments.join(),
    );
  }
});
