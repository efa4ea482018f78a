/**
 * What can be staged and how its gates are said: names and colours instead of numbers, the units of
 * the page, what stops a command and what may override it, and a send button that is always there.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { doubleStage, hold, kDeskSizes, kScreenshots, show, until } from "./stage.mjs";
import { greetings, nothingKnown, refusedCommand, stopped } from "./story.mjs";

const stage = doubleStage((double) => {
  double.greetings = greetings(double).filter((m) => m.type !== "command");
});
const named = (size) => size.join(" x ");
const sent = (type) => stage.double.received.filter((m) => m.type === type);

/** Of what an element says, only what can be seen of it without scrolling. */
const inSight = (selector) => {
  const element = document.querySelector(selector);
  if (!element) return false;
  const { left, top, right, bottom, width, height } = element.getBoundingClientRect();
  const corners = [
    [left + 2, top + 2],
    [right - 2, top + 2],
    [left + 2, bottom - 2],
    [right - 2, bottom - 2],
  ];
  return (
    width > 0 &&
    height > 0 &&
    corners.every(([x, y]) => {
      const at = document.elementFromPoint(x, y);
      return at === element || element.contains(at);
    })
  );
};

const choices = (page) =>
  page.$$eval(".choices .choice", (rows) =>
    rows.map((row) => [
      row.innerText.trim(),
      row.dataset.flag,
      getComputedStyle(row.querySelector(".cloth")).backgroundColor,
    ]),
  );

for (const size of kDeskSizes) {
  test(`${named(size)}: flags are chosen by name and colour`, async () => {
    const { page, faults } = await stage.open({ size, hash: "#/commands" });
    await page.selectOption('select[aria-label="command"]', "track flag");
    const offered = await choices(page);
    assert.deepEqual(
      offered.map(([name, colour]) => `${name} ${colour}`),
      [
        "none none",
        "RED red",
        "ORANGE orange",
        "YELLOW yellow",
        "GREEN green",
        "WAVING GREEN green",
        "CHEQUERED chequered",
      ],
    );
    assert.equal(offered[1][2], "rgb(212, 0, 0)");
    assert.equal(await page.isDisabled(".stage button[type=submit]"), true, "none is chosen yet");
    await page.click('.choice:has-text("YELLOW")');
    await page.click(".stage button[type=submit]");
    await stage.arrived(page);
    assert.deepEqual(sent("stage"), [{ type: "stage", name: "track flag", argument: 3 }]);
    await page.screenshot({ path: join(kScreenshots, `flags_${size[0]}.png`) });
    assert.deepEqual(faults, []);
  });

  test(`${named(size)}: sensors are excluded by name`, async () => {
    const { page } = await stage.open({ size, hash: "#/commands" });
    await page.selectOption('select[aria-label="command"]', "sensors excluded");
    const names = (await choices(page)).map(([name]) => name);
    const { labels } = stage.double.catalogue.commands.find((c) => c.name === "sensors excluded");
    assert.deepEqual(
      names,
      labels.filter((label) => label !== "-"),
    );
    assert.ok(names.includes("gnss0"));
    await page.click('.choice:has-text("gnss1")');
    await page.click('.choice:has-text("gnss0")');
    await page.click('.choice:has-text("gnss0")');
    await page.click(".stage button[type=submit]");
    await stage.arrived(page);
    assert.equal(sent("stage")[0].argument, 2 ** labels.indexOf("gnss1"));
  });

  test(`${named(size)}: what no car carries out is not offered`, async () => {
    const { page } = await stage.open({ size, hash: "#/commands" });
    const offered = await page.$$eval('select[aria-label="command"] option', (options) =>
      options.map((option) => option.value),
    );
    assert.deepEqual(offered, [
      "arm",
      "reset",
      "speed limit",
      "track flag",
      "sensors excluded",
      "fuel entered",
      "end run",
    ]);
    for (const [command, names] of [
      ["arm", ["disarm", "arm"]],
      ["reset", ["reset"]],
      ["end run", ["end"]],
    ]) {
      await page.selectOption('select[aria-label="command"]', command);
      assert.deepEqual(
        (await choices(page)).map(([name]) => name),
        names,
      );
    }
  });

  for (const state of ["a car that drives", "a stopped car"]) {
    test(`${named(size)}, ${state}: send is in sight, whatever refuses`, async () => {
      const now = stage.double.nowMs();
      stage.double.greetings.push({ ...refusedCommand(now), gates: nothingKnown });
      if (state === "a stopped car") stage.double.greetings.push(stopped(now));
      const { page } = await stage.open({ size, hash: "#/commands" });
      await until(page, "nine gates", () => document.querySelectorAll(".gate").length === 9);
      for (const selector of [".send", ".override input", ".staged .tools button:nth-child(2)"]) {
        assert.ok(await page.evaluate(inSight, selector), selector);
      }
      await page.screenshot({
        path: join(kScreenshots, `send_${size[0]}_${state.split(" ")[1]}.png`),
      });
    });
  }

  test(`${named(size)}: gates speak the page's units, and say where there is no data`, async () => {
    stage.double.greetings.push(refusedCommand(stage.double.nowMs()));
    const { page } = await stage.open({ size, hash: "#/commands" });
    await until(page, "gates", () => document.querySelector(".gate"));
    const gates = () => page.innerText(".gates");
    assert.match(await gates(), /20\.1 mph/, "9 m/s");
    assert.match(await gates(), /\+20\.1 mph, at most \+11\.2 mph/);
    assert.match(await gates(), /79\.0 \u00b0C needed for 159\.0 mph/);
    assert.match(await gates(), /GREEN/);
    assert.doesNotMatch(await gates(), /m\/s|degC/);
    await page.keyboard.press("u");
    assert.match(await gates(), /\+32\.4 km\/h, at most \+18\.0 km\/h/);
    await page.keyboard.press("u");
    assert.match(await gates(), /\+9\.0 m\/s, at most \+5\.0 m\/s/);
    await page.keyboard.press("u");
    stage.double.say({ ...refusedCommand(stage.double.nowMs()), ticket: 90, gates: nothingKnown });
    await until(page, "both", () => document.querySelectorAll(".staged").length === 2);
    const all = await page.innerText(".commands-page");
    assert.match(all, /no data/);
    assert.doesNotMatch(all, /\bnan\b|NaN|undefined|null/i);
  });

  test(`${named(size)}: without tokens an override takes a reason and a hold`, async () => {
    stage.double.hello.second_person = false;
    stage.double.greetings.push(refusedCommand(stage.double.nowMs()));
    const { page } = await stage.open({ size, hash: "#/commands" });
    await until(page, "gates", () => document.querySelector(".gate"));
    assert.equal(await page.locator(".override input[type=password]").count(), 0);
    assert.equal(await page.isDisabled("button.send"), true);
    await page.fill(".override input", "dry again");
    await page.click("button.send");
    await page.waitForTimeout(700);
    await stage.arrived(page);
    assert.deepEqual(sent("send"), [], "a tap sends nothing");
    await hold(page, "button.send", 900);
    await stage.arrived(page);
    assert.deepEqual(sent("send"), [
      { type: "send", ticket: 41, override: { reason: "dry again" } },
    ]);
  });
}

test("a gate that nobody may override leaves no way to send", async () => {
  const command = refusedCommand(stage.double.nowMs());
  command.gates[1] = { ...command.gates[1], ok: false };
  stage.double.greetings.push(command);
  const { page } = await stage.open({ hash: "#/commands" });
  await until(page, "why", () => document.querySelector(".wants"));
  assert.match(await page.innerText(".wants"), /never overridden: link/);
  assert.equal(await page.locator(".override").count(), 0);
  assert.equal(await page.isDisabled("button.send"), true);
});

test("a message for race control is read out, copied, and marked as reported", async () => {
  const { page } = await stage.open({ hash: "#/link" });
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  for (const name of ["link", "race"]) {
    await show(page, name);
    const text = await page.innerText(".notice");
    assert.match(text, /Read out to race control/);
    assert.doesNotMatch(text, /\bsend\b/i, "nothing is sent from here");
  }
  await page.click('.notice button:has-text("Copy")');
  await until(page, "copied", () => document.querySelector(".notice").innerText.includes("copied"));
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(copied, /Car 7: radio degraded since .*loss 14 %/);
  await page.click('.notice button:has-text("Reported to race control")');
  await stage.arrived(page);
  assert.deepEqual(sent("notice"), [{ type: "notice", id: 1, do: "reported" }]);
  const notice = stage.double.greetings.find((m) => m.type === "notice");
  stage.double.say({ ...notice, state: "reported", by: "Ada" });
  await until(page, "who reported it", () =>
    document.querySelector(".settled")?.innerText.includes("reported by Ada"),
  );
  assert.equal(await page.locator(".notice").count(), 0);
});
