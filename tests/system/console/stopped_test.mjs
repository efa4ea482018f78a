/**
 * The console while the car is stopped, and while the base is gone: what stopped the car and the
 * way back stand beside every page, nothing on the page looks alive without a base, and what
 * remains to be done is told.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { Double } from "./double.mjs";
import { doubleStage, hold, kDeskSizes, kPages, kScreenshots, show, until } from "./stage.mjs";
import { alarms, greetings, stopped } from "./story.mjs";

const stage = doubleStage((double) => (double.greetings = greetings(double)));
const named = (size) => size.join(" x ");

/** What reached the base of the way back and of stops. */
const asked = () => stage.double.received.filter((m) => ["recover", "stop"].includes(m.type));

/** A car that has stopped, with an operator here who holds the authority. */
function stopTheCar(more = {}) {
  stage.double.greetings = [
    ...greetings(stage.double).filter((m) => m.type !== "stop_state"),
    stopped(stage.double.nowMs(), more),
  ];
}

/** True where the whole element can be seen and lies over everything else. */
const inSight = (selector) => {
  const element = document.querySelector(selector);
  if (!element) return false;
  const { left, top, right, bottom, width, height } = element.getBoundingClientRect();
  const inside = left >= 0 && top >= 0 && right <= innerWidth + 1 && bottom <= innerHeight + 1;
  const at = document.elementFromPoint(left + width / 2, top + height / 2);
  return inside && width > 0 && height > 0 && (at === element || element.contains(at));
};

for (const size of kDeskSizes) {
  test(`${named(size)}: the cause of a stop and the way back stand beside every page`, async () => {
    stopTheCar();
    const { page, faults } = await stage.open({ size });
    for (const name of kPages) {
      await show(page, name);
      await until(page, `the card on ${name}`, inSight, ".stop-card h2");
      const said = await page.innerText(".stop-card");
      assert.match(said, /CONTROLLED STOP/);
      assert.match(said, /dead reckoning too long/);
      assert.match(said, /1\.60 s/);
      assert.match(said, /\d\d:\d\d:\d\d UTC, \d+:\d\d ago/);
      assert.match(said, /latched by\s+Ada/);
      const steps = await page.$$eval(".stop-card li", (rows) =>
        rows.map((row) => [row.dataset.step, row.dataset.standing, row.innerText]),
      );
      assert.deepEqual(
        steps.map(([step, standing]) => `${step} ${standing}`),
        ["release possible", "acknowledge possible", "reset waits", "arm waits"],
      );
      assert.match(steps[2][2], /release the stop first/);
      assert.match(steps[3][2], /reset the car first/);
      for (const step of ["release", "acknowledge", "reset", "arm"]) {
        assert.ok(await page.evaluate(inSight, `.stop-card [data-step="${step}"] button`), step);
      }
      await page.screenshot({ path: join(kScreenshots, `stopped_${name}_${size[0]}.png`) });
    }
    assert.deepEqual(faults, []);
  });

  test(`${named(size)}: a release is held, and names the latch that was shown`, async () => {
    stopTheCar();
    const { page } = await stage.open({ size });
    await page.click('.stop-card [data-step="release"] button');
    await page.waitForTimeout(800);
    await stage.arrived(page);
    assert.deepEqual(asked(), [], "a tap releases nothing");
    await hold(page, '.stop-card [data-step="release"] button', 900);
    await stage.arrived(page);
    assert.deepEqual(asked(), [{ type: "recover", step: "release", challenge: 4711 }]);
    await page.click('.stop-card [data-step="acknowledge"] button');
    await stage.arrived(page);
    assert.deepEqual(asked().at(-1), { type: "recover", step: "acknowledge" });
    assert.equal(await page.isDisabled('.stop-card [data-step="reset"] button'), true);
    assert.equal(await page.isDisabled('.stop-card [data-step="arm"] button'), true);
  });

  test(`${named(size)}: without a base nothing looks alive, what remains is told`, async () => {
    stopTheCar();
    const { page } = await stage.open({ size });
    await until(page, "LIVE", () => document.querySelector(".behind").textContent === "LIVE");
    await stage.double.close();
    await until(page, "the band", inSight, ".no-base strong");
    for (const name of kPages) {
      await show(page, name);
      await page.waitForTimeout(150);
      const seen = await page.evaluate(() => ({
        word: document.querySelector(".no-base strong").textContent,
        share: document.querySelector(".no-base").getBoundingClientRect().width / innerWidth,
        behind: document.querySelector(".behind").textContent,
        line: document.querySelector(".alarm-line").innerText,
        priority: document.querySelector(".alarm-line").dataset.priority,
        counts: document.querySelector(".alarm-counts").innerText,
        badges: document.querySelectorAll(".badge").length,
        live: [...document.querySelectorAll("button.stop, .stop-card button, .send, .alarm button")]
          .filter((button) => !button.disabled)
          .map((button) => button.textContent),
        rail: document.querySelector(".stop-rail").innerText,
        remains: [...document.querySelectorAll(".no-base li")].map((e) => e.textContent),
      }));
      assert.equal(seen.word, "NO BASE");
      assert.ok(seen.share > 0.97, `the band takes ${seen.share} of the width`);
      assert.notEqual(seen.behind, "LIVE");
      assert.match(seen.line, /not known/);
      assert.equal(seen.priority, "none");
      assert.doesNotMatch(seen.counts, /\d/);
      assert.equal(seen.badges, 0);
      assert.deepEqual(seen.live, [], `living buttons on ${name}`);
      assert.match(seen.rail, /NO BASE/);
      assert.match(seen.remains.join("\n"), /Race control/);
      assert.match(seen.remains.join("\n"), /by itself/);
      assert.match(seen.remains.join("\n"), /spare/);
    }
    await show(page, "primary");
    await page.screenshot({ path: join(kScreenshots, `no_base_${size[0]}.png`) });
    const port = Number(new URL(stage.address).port);
    stage.double = new Double();
    stage.double.greetings = greetings(stage.double);
    await stage.double.listen(port);
    await until(page, "a living console again", () => {
      const stop = document.querySelector("button.stop.controlled:not(:disabled)");
      return stop && !document.querySelector(".no-base");
    });
  });
}

test("a base that is silent for a second: a stop still goes out; for three: no more", async () => {
  const { page } = await stage.open();
  clearInterval(stage.double.timer);
  const silent = (presence) => document.querySelector(".no-base")?.dataset.presence === presence;
  await until(page, "the band", silent, "silent");
  assert.equal(await page.isDisabled("button.stop.controlled"), false);
  await page.click("button.stop.controlled");
  await until(page, "no more", silent, "gone");
  assert.equal(await page.isDisabled("button.stop.controlled"), true);
  assert.deepEqual(asked(), [{ type: "stop", kind: "controlled" }]);
});

test("a page that was opened without a base says so", async () => {
  const context = await stage.browser.newContext();
  const page = await context.newPage();
  await page.routeWebSocket(/./, (socket) => socket.close());
  await page.goto(`${stage.address}/`);
  await until(page, "the band", () => document.querySelector(".no-base"));
  assert.equal(await page.isDisabled("button.stop.controlled"), true);
});

test("who does not command sees the stop, and is shown the way to the authority", async () => {
  stopTheCar();
  stage.double.greetings.push({
    type: "authority",
    holder: 0,
    holder_name: null,
    epoch: 4,
    expires_ms: null,
    request: null,
  });
  const { page } = await stage.open();
  await until(page, "the card", () => document.querySelector(".stop-card"));
  assert.equal(await page.isDisabled('.stop-card [data-step="release"] button'), true);
  assert.equal(await page.isDisabled('.stop-card [data-step="acknowledge"] button'), false);
  await page.click('.stop-card button:has-text("Take the authority")');
  await stage.arrived(page);
  assert.deepEqual(
    stage.double.received.filter((m) => m.type === "authority" && m.do !== "renew"),
    [{ type: "authority", do: "take" }],
  );
});

test("an emergency stop that nobody has seen stays in sight when the link is lost", async () => {
  stage.double.greetings = greetings(stage.double);
  const { page } = await stage.open();
  const now = stage.double.nowMs();
  const list = alarms(now);
  const stop = { ...list.active[0], id: 91, key: "emergency_stop", text: "Emergency stop" };
  const lost = { ...list.active[0], id: 92, key: "link_lost", text: "No packet from the car" };
  Object.assign(stop, { since_ms: now - 9000, can_be_shelved: false });
  stage.double.say({ ...list, active: [lost, stop, ...list.active.slice(1)] });
  await show(page, "alarms");
  await until(page, "both", () => document.querySelectorAll(".alarm").length === 5);
  const row = page.locator('.alarm:has-text("Emergency stop")');
  assert.equal(await row.locator('button:has-text("Shelve")').count(), 0);
  assert.equal(await row.locator('button:has-text("Ack")').count(), 1);
  await row.focus();
  await page.keyboard.press("s");
  assert.equal(await page.locator(".dialog").count(), 0, "no shelf for a stop");
});
