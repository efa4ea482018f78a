/**
 * Hands on the console: stops, holding, keys. What reaches the base is exactly what was meant, and
 * no single key ever sends a command.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  doubleStage,
  escapeTwice,
  hold,
  kDeskSizes,
  kPages,
  reach,
  show,
  until,
} from "./stage.mjs";
import { greetings } from "./story.mjs";

const stage = doubleStage((double) => (stage.double.greetings = greetings(double)));

const kDoubleEscapeMs = 600;
const kHarmless = ["history", "mark", "ack", "ping"];
const commands = () =>
  stage.double.received.filter(
    (m) => !kHarmless.includes(m.type) && !(m.type === "authority" && m.do === "renew"),
  );

test("no single key sends a command", async () => {
  const { page } = await stage.open();
  for (const name of kPages) {
    await show(page, name);
    for (let code = 32; code < 127; ++code) {
      await page.keyboard.press(String.fromCharCode(code));
      await page.evaluate((hash) => {
        document.querySelector(".veil")?.click();
        document.activeElement?.blur?.();
        location.hash = hash;
      }, `#/${name}`);
    }
    assert.deepEqual(await reached(page), [], `on ${name}`);
  }
});

/** A page whose clock stands still until the test moves it on. */
async function stopped(options) {
  const { page } = await stage.open({ ...options, ownClock: true });
  await page.clock.pauseAt((await page.evaluate(() => Date.now())) + 2000);
  return page;
}

/** What has reached the base once everything sent so far has. */
async function reached(page) {
  await stage.arrived(page);
  return commands();
}

test("Escape twice within 600 ms is a controlled stop, later it is none", async () => {
  const page = await stopped();
  await page.keyboard.press("Escape");
  await page.clock.runFor(620);
  await page.keyboard.press("Escape");
  await page.clock.runFor(620);
  assert.deepEqual(await reached(page), []);
  await page.keyboard.press("Escape");
  await page.clock.runFor(580);
  await page.keyboard.press("Escape");
  assert.deepEqual(await reached(page), [{ type: "stop", kind: "controlled" }]);
});

for (const size of kDeskSizes) {
  test(`${size.join(" x ")}: an Escape that closes something is no half of a stop`, async () => {
    const { page } = await stage.open({ size });
    const openings = [
      ["help", () => page.keyboard.press("?")],
      ["finder", () => page.keyboard.press("/")],
      ["shelf", () => page.keyboard.press("s")],
    ];
    for (const [name, open] of openings) {
      await open();
      await until(page, name, () => document.querySelector(".dialog"));
      await page.keyboard.press("Escape");
      await until(page, `no ${name}`, () => !document.querySelector(".dialog"));
      await page.keyboard.press("Escape");
      await page.waitForTimeout(kDoubleEscapeMs + 50);
      assert.deepEqual(await reached(page), [], name);
    }
    await escapeTwice(page);
    assert.deepEqual(await reached(page), [{ type: "stop", kind: "controlled" }]);
  });
}

test("stops work from inside a text field, a dialog and a held view", async () => {
  const { page } = await stage.open();
  await page.keyboard.press(" ");
  await until(page, "held", () => document.querySelector('.frame[data-held="true"]'));
  await page.keyboard.press("/");
  await page.keyboard.type("ego");
  await page.keyboard.press("Control+Shift+E");
  assert.deepEqual(await reached(page), [{ type: "stop", kind: "emergency" }]);
  await page.keyboard.press("Escape"); // closes the dialog
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await page.click("button.stop.controlled");
  assert.equal((await reached(page)).length, 3);
});

test("the emergency button acts after 400 ms, not on a tap", async () => {
  const page = await stopped();
  const box = await page.locator("button.stop.emergency").boundingBox();
  const at = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(...at);
  await page.mouse.down();
  await page.clock.runFor(380);
  await page.mouse.up();
  await page.mouse.down();
  await page.clock.runFor(380);
  await page.mouse.move(at[0] - 400, at[1]);
  await page.clock.runFor(500);
  await page.mouse.up();
  assert.deepEqual(await reached(page), []);
  await page.mouse.move(...at);
  await page.mouse.down();
  await page.clock.runFor(420);
  await page.mouse.up();
  assert.deepEqual(await reached(page), [{ type: "stop", kind: "emergency" }]);
});

test("a stop without a base says that it was not sent", async () => {
  const { page } = await stage.open();
  await stage.double.close();
  await until(page, "no connection", () => !globalThis.pitwall.session.connected.value);
  assert.equal(await page.isDisabled("button.stop.controlled"), true);
  await escapeTwice(page);
  await until(page, "NOT SENT", () =>
    document.querySelector(".outcome").textContent.startsWith("NOT SENT"),
  );
  await stage.double.listen();
});

test("a viewer cannot stop, and is told so", async () => {
  stage.double.hello.role = "viewer";
  const { page } = await stage.open();
  assert.equal(await page.isDisabled("button.stop.controlled"), true);
  assert.match(await page.textContent(".stop-rail"), /viewer/);
});

test("stage, gates, hold: the keyboard alone, from any page", async () => {
  stage.double.greetings = stage.double.greetings.filter((m) => m.type !== "command");
  stage.double.answers = (message, say) => {
    if (message.type !== "stage") return;
    say({
      type: "command",
      ticket: 50,
      name: message.name,
      argument: message.argument,
      by: "console 16",
      step: "gated",
      times_ms: { staged: 1, gated: 2 },
      text: "",
      gates: [{ name: "tyres", ok: true, value: 81, age_ms: 100, text: "warm" }],
    });
  };
  const { page } = await stage.open({ ownClock: true });
  await page.keyboard.press("5");
  await reach(page, 'select[aria-label="command"]');
  await page.keyboard.type("speed");
  await reach(page, 'input[aria-label="argument"]');
  await page.keyboard.press("Control+A");
  await page.keyboard.type("120");
  await page.keyboard.press("Enter");
  await until(page, "the gates", () => document.querySelector(".gate[data-ok=true]"));
  const staged = commands().find((m) => m.type === "stage");
  assert.equal(staged.name, "speed limit");
  assert.ok(Math.abs(staged.argument - 53.645) < 0.01, `${staged.argument} m/s of 120 mph`);
  await reach(page, "button.send");
  await page.clock.pauseAt((await page.evaluate(() => Date.now())) + 2000);
  await page.keyboard.down("Enter");
  await page.clock.runFor(580);
  await page.keyboard.up("Enter");
  await page.clock.runFor(580);
  const sent = (await reached(page)).filter((m) => m.type === "send");
  assert.deepEqual(sent, [], "released early");
  await page.keyboard.down("Enter");
  await page.clock.runFor(620);
  await page.keyboard.up("Enter");
  assert.deepEqual((await reached(page)).at(-1), { type: "send", ticket: 50 });
});

test("a gate that refuses needs a reason and a second person", async () => {
  const { page } = await stage.open({ hash: "#/commands" });
  assert.equal(await page.locator('.gate[data-ok="false"]').count(), 3);
  assert.equal(await page.isDisabled("button.send"), true);
  await page.fill(".override input:not([type])", "test run");
  assert.equal(await page.isDisabled("button.send"), true);
  await page.fill(".override input[type=password]", "secret");
  await hold(page, "button.send", 900);
  assert.deepEqual((await reached(page)).at(-1), {
    type: "send",
    ticket: 41,
    override: { reason: "test run", token: "secret" },
  });
});

test("keys find a field, plot it and acknowledge an alarm", async () => {
  const { page } = await stage.open();
  await page.keyboard.press("/");
  await page.keyboard.type("oil_pres");
  await page.keyboard.press("Enter");
  await until(
    page,
    "the plot",
    () =>
      location.hash === "#/plots" &&
      document.querySelector('[aria-label="chart engine oil pressure"] canvas'),
  );
  await page.keyboard.press("a");
  await stage.arrived(page);
  const acks = () => stage.double.received.filter((m) => m.type === "ack");
  assert.deepEqual(acks(), [{ type: "ack", alarm: 1 }]);
  await page.keyboard.press("A");
  await stage.arrived(page);
  assert.deepEqual(acks(), [
    { type: "ack", alarm: 1 },
    { type: "ack", all: [1, 2, 4] },
  ]);
});

test("pause, scrub and back to live concern the view alone", async () => {
  const { page } = await stage.open({ hash: "#/telemetry" });
  await page.waitForTimeout(2500);
  const lap = () =>
    page.evaluate(() => {
      const { session } = globalThis.pitwall;
      return session.history.newestMs();
    });
  const before = await lap();
  await page.keyboard.press(" ");
  await page.keyboard.press("ArrowLeft");
  await until(page, "the past", () =>
    /^\u2212[12]\.\d s$/.test(document.querySelector(".behind").textContent),
  );
  const station = () => page.textContent('[data-path="ego.x"] .digits');
  const held = await station();
  await page.waitForTimeout(600);
  assert.equal(await station(), held, "the view stands still");
  assert.ok((await lap()) > before, "the record runs on");
  await page.keyboard.press("l");
  await until(page, "live", () => document.querySelector(".behind").textContent === "LIVE");
  await until(
    page,
    "the present",
    (past) => document.querySelector('[data-path="ego.x"] .digits').textContent !== past,
    held,
  );
});
