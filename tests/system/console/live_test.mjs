/**
 * What the console shows of the car is alive, or says that it is not: first values as soon as it is
 * loaded, a silent car and a silent base both take every colour away, and the console comes back by
 * itself.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { Double } from "./double.mjs";
import { doubleStage, escapeTwice, kPages, kScreenshots, show, until } from "./stage.mjs";
import { checklist, kRecordings } from "./story.mjs";
import { kBad, kWarning } from "./wire.mjs";

const stage = doubleStage();

/** Values drawn with a colour, or as if they were fresh: there must be none when all is silent. */
const alive = () =>
  [...document.querySelectorAll(".value, .bar")]
    .filter(
      (e) =>
        ["fresh", "late"].includes(e.dataset.quality) ||
        (e.dataset.judgement ?? "none") !== "none" ||
        (e.dataset.flag ?? "none") !== "none",
    )
    .map((e) => e.dataset.path ?? e.getAttribute("aria-label"));

test("the first snapshot is enough, and it is asked for before the page is loaded", async () => {
  clearInterval(stage.double.timer); // the base greets, and then sends nothing more
  const opened = () => {
    const Native = WebSocket;
    globalThis.WebSocket = class extends Native {
      constructor(url) {
        super(url);
        globalThis.openedWhile ??= document.readyState;
      }
    };
  };
  const { page } = await stage.open({ script: opened, ready: '[data-path="ego.vx"]' });
  await until(page, "62 m/s in mph", () =>
    /^1[34]\d$/.test(document.querySelector('[data-path="ego.vx"] .digits')?.textContent),
  );
  assert.equal(await page.evaluate(() => globalThis.openedWhile), "interactive");
});

test("a field that was never heard is an en dash, a zero is a zero", async () => {
  const { page } = await stage.open({ hash: "#/telemetry" });
  await page.fill("input[type=search]", "uplink.stop_reason");
  await until(
    page,
    "an en dash",
    () =>
      document.querySelector('[data-path="uplink.stop_reason"] .digits')?.textContent === "\u2013",
  );
  await page.fill("input[type=search]", "feedback.brake_front");
  await until(
    page,
    "a zero",
    () => document.querySelector('[data-path="feedback.brake_front"] .digits')?.textContent === "0",
  );
});

test("a sensor that sees other cars has a row when the car has it", async () => {
  const { page } = await stage.open();
  await until(
    page,
    "the LiDARs",
    () =>
      document.querySelector('[data-path="sensors.lidar1_drops"] .digits')?.textContent === "12",
  );
  const rows = await page.evaluate(() =>
    [...document.querySelectorAll(".panel-sensors tbody tr")]
      .filter((row) => row.getClientRects().length > 0)
      .map((row) =>
        [...row.children].map((cell) => (cell.querySelector(".digits") ?? cell).textContent),
      ),
  );
  assert.deepEqual(
    rows.map(([name]) => name),
    [
      ...["GNSS 0", "GNSS 1", "IMU 0", "IMU 1"],
      ...["LiDAR", "LiDAR 0", "LiDAR 1", "LiDAR 2", "camera 0", "radar"],
    ],
  );
  assert.deepEqual(rows[6], ["LiDAR 1", "20.0", "55", "8", "12"]);
});

test("the car falls silent: every value stale, none coloured, each keeps its digits", async () => {
  for (const path of ["derived.slip", "tyres.temperature_front_left", "sensors.lidar_rate"]) {
    stage.double.set(path, 0.5, path.startsWith("derived") ? kBad : kWarning);
  }
  stage.double.set("mode.stop_latch", 1);
  const { page } = await stage.open();
  await until(page, "colours", () => document.querySelector('[data-judgement="bad"]'));
  const outcome = () => document.querySelector(".outcome").textContent;
  await until(page, "a latched stop", () =>
    document.querySelector(".outcome").textContent.startsWith("car: "),
  );
  const before = await page.textContent('[data-path="derived.slip"] .digits');
  stage.double.silence();
  for (let n = 0; n < 100 && (await page.evaluate(alive)).length > 0; ++n) {
    await page.waitForTimeout(100);
  }
  assert.deepEqual(await page.evaluate(alive), []);
  assert.equal(await page.textContent('[data-path="derived.slip"] .digits'), before);
  const drawn = await page.evaluate(() => {
    const digits = document.querySelector('[data-path="ego.vx"] .digits');
    const style = getComputedStyle(digits);
    return {
      line: style.textDecorationLine,
      age: document.querySelector('[data-path="ego.vx"] .age').textContent,
    };
  });
  assert.equal(drawn.line, "line-through");
  assert.match(drawn.age, /s$/);
  assert.equal(await page.evaluate(outcome), "", "an old stop is no stop that is known");
  const ageless = () =>
    [...document.querySelectorAll('.value[data-quality="stale"]')]
      .filter((e) => e.querySelector(".age")?.textContent === "")
      .map((e) => e.dataset.path);
  assert.deepEqual(await page.evaluate(ageless), [], "every old value says how old");
});

test("the base dies: nothing looks alive, and a new one is found again", async () => {
  const { page } = await stage.open();
  const port = Number(new URL(stage.address).port);
  await stage.double.close();
  await until(page, "NO BASE", () =>
    document.querySelector(".link-tile .word").textContent.startsWith("NO BASE"),
  );
  for (const name of kPages) {
    await show(page, name);
    await page.waitForTimeout(400);
    assert.deepEqual(await page.evaluate(alive), [], `page ${name}`);
  }
  const silence = await page.textContent(".link-tile .word");
  assert.match(silence, /\d/, "says for how long");
  stage.double = new Double();
  await stage.double.listen(port);
  await until(page, "fresh values again", () => document.querySelector('[data-quality="fresh"]'));
});

test("what cannot be used is counted and changes nothing; what was lost is shown", async () => {
  const { page, faults } = await stage.open();
  for (const socket of stage.double.sockets.clients) {
    for (const text of ["", "{", "null", "[]", '{"type":"constructor"}', '{"type":7}']) {
      socket.send(text);
    }
    socket.send(Buffer.from([9, 9, 9]));
    socket.send(Buffer.alloc(4000, 255));
  }
  await until(page, "all counted", () => {
    const { counters } = globalThis.pitwall.session;
    return counters.badFrames === 2 && counters.badTexts === 6;
  });
  assert.equal(await page.textContent(".mode-word strong"), "HIL 7");
  stage.double.dropped = 37;
  await until(
    page,
    "what it lost",
    () => document.querySelector(".clocks .lost").innerText === "37 lost",
  );
  assert.deepEqual(faults, []);
});

test("in which world we are cannot be mistaken", async () => {
  const seen = new Set();
  for (const mode of ["REAL", "HIL", "REPLAY", "NONE"]) {
    stage.double.hello.mode = mode;
    const { page, context } = await stage.open();
    await until(page, "mode", (m) => document.querySelector(".frame").dataset.mode === m, mode);
    const look = await page.evaluate(() => {
      const border = getComputedStyle(document.querySelector(".frame"), "::after");
      const word = document.querySelector(".mode-word");
      return [
        word.textContent,
        border.borderTopStyle,
        border.borderImageSource,
        getComputedStyle(word).backgroundColor,
      ].join(" | ");
    });
    seen.add(look);
    const stops = await page.locator("button.stop").count();
    assert.equal(stops, mode === "REPLAY" ? 0 : 2, `stop buttons in ${mode}`);
    await context.close();
  }
  assert.equal(seen.size, 4, [...seen].join("\n"));
});

test("a replay is moved by its own bar and keys, and a jump forgets what came before", async () => {
  stage.double.hello.mode = "REPLAY";
  const playing = {
    type: "playback",
    begin_ms: 0,
    end_ms: 600_000,
    now_ms: 100_000,
    speed: 1,
  };
  stage.double.greetings = [
    { ...playing, jumps: 0 },
    {
      type: "audit",
      time_ms: 1,
      who: "console 16",
      what: "speed limit",
      result: "sent",
    },
  ];
  const { page } = await stage.open();
  const asked = () => stage.double.received.filter((m) => m.type === "playback");
  await page.keyboard.press(" ");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("+");
  await escapeTwice(page);
  await page.keyboard.press("Control+Shift+E");
  await stage.arrived(page);
  assert.deepEqual(asked(), [
    { type: "playback", speed: 0 },
    { type: "playback", to_ms: 99_000 },
    { type: "playback", speed: 2 },
  ]);
  assert.deepEqual(
    stage.double.received.filter((m) => m.type === "stop"),
    [],
    "nothing is stopped in a replay",
  );
  await until(page, "the audit line", () => globalThis.pitwall.session.audit.value.length === 1);
  stage.double.say({ ...playing, now_ms: 99_000, jumps: 1 });
  await until(page, "all forgotten", () => globalThis.pitwall.session.audit.value.length === 0);
});

const kLaterScript = /\/assets\/page-.*\.js$/;
const fetchedLater = () =>
  performance.getEntriesByType("resource").some((e) => /assets\/page-.*\.js$/.test(e.name));

test("pages outside the first load are there before they are shown, without a base", async () => {
  const { page } = await stage.open();
  await until(page, "the page that nobody asked for", fetchedLater);
  await page.waitForLoadState("networkidle");
  await stage.double.close();
  await until(page, "no base", () => !globalThis.pitwall.session.connected.value);
  await show(page, "plots");
  await until(page, "charts", () => document.querySelectorAll(".chart canvas").length > 3);
  await stage.double.listen(Number(new URL(stage.address).port)); // for the next to close
});

test("a page that did not come is asked for again", async () => {
  const context = await stage.browser.newContext();
  const page = await context.newPage();
  let refuse = true;
  await page.route(kLaterScript, (route) => (refuse ? route.abort() : route.continue()));
  await page.goto(`${stage.address}/#/plots`);
  await until(page, "what is missing", () =>
    document.querySelector(".page .empty")?.textContent.includes("has not come"),
  );
  refuse = false;
  await show(page, "primary");
  await until(page, "another page", () => document.querySelector(".primary"));
  await show(page, "plots");
  await until(page, "charts", () => document.querySelectorAll(".chart canvas").length > 3);
});

test("the check list is the base's own; an old one, or a silent base's, is not known", async () => {
  let said = { ...checklist(0), go: false };
  stage.double.checklist = (now) => ({ ...said, time_ms: now });
  const { page } = await stage.open({ hash: "#/replay" });
  const verdict = (wanted) => document.querySelector(".checklist output")?.textContent === wanted;
  await until(page, "no-go", verdict, "NO-GO");
  const rows = () =>
    [...document.querySelectorAll(".check")].map((e) => [
      e.querySelector(".name").textContent,
      e.dataset.verdict,
    ]);
  const wanted = said.checks.map((c) => [c.name, c.go ? "go" : "no-go"]);
  assert.deepEqual(await page.evaluate(rows), wanted);
  assert.match(await page.textContent(".check:nth-child(9) .age"), /^(8|9)\.\d s$/);
  // Every item a go, and yet the base says no: the page does not know better.
  said = { ...said, checks: said.checks.map((c) => ({ ...c, go: true })) };
  await until(
    page,
    "rows",
    () => document.querySelectorAll('[data-verdict="go"].check').length === 12,
  );
  assert.equal(await page.evaluate(verdict, "NO-GO"), true);
  said.go = true;
  await until(page, "go", verdict, "GO");
  stage.double.checklist = null;
  await until(page, "an old list", verdict, "NOT KNOWN");
  assert.equal(await page.locator('.check[data-verdict="unknown"]').count(), 12);
  stage.double.checklist = (now) => ({ ...said, time_ms: now });
  await until(page, "go again", verdict, "GO");
  await stage.double.close();
  await until(page, "a silent base", verdict, "NOT KNOWN");
  await stage.double.listen(Number(new URL(stage.address).port)); // for the next to close
});

test("recordings are listed, and what plays one is told", async () => {
  stage.double.recordings = kRecordings;
  const { page, faults } = await stage.open({ hash: "#/replay" });
  await until(
    page,
    "the list",
    () => document.querySelectorAll(".recordings tbody tr").length === 4,
  );
  await page.click('.recordings button:has-text("warm_up")');
  const line = await page.inputValue(".command-line input");
  assert.equal(line, kRecordings.recordings[2].command);
  await page.click('.recordings button:has-text("copied")');
  assert.equal(await page.locator(".command-line").count(), 0, "nothing to play");
  assert.deepEqual(faults, []);
});

test("laps lie over each other by distance", async () => {
  const { page, faults } = await stage.open({ hash: "#/plots" });
  await until(page, "charts", () => document.querySelectorAll(".chart canvas").length === 6);
  const select = page.locator('.plots label:has-text("over") select');
  await select.selectOption("distance");
  const lines = () =>
    [...document.querySelectorAll('[aria-label="chart speed"] .read-outs li')].map((e) => [
      e.querySelector(".name").textContent,
      /\d/.test(e.querySelector(".digits").textContent),
    ]);
  await until(page, "this lap's value", () =>
    /\d/.test(document.querySelector('[aria-label="chart speed"] .digits').textContent),
  );
  // Two fields leave room for three laps each; this console has seen one.
  assert.deepEqual(await page.evaluate(lines), [
    ["speed", true],
    ["lap \u22121", false],
    ["lap \u22122", false],
    ["target speed", true],
    ["lap \u22121", false],
    ["lap \u22122", false],
  ]);
  await page.screenshot({ path: join(kScreenshots, "plots_laps.png") });
  await select.selectOption("time");
  await until(
    page,
    "two lines",
    () => document.querySelectorAll('[aria-label="chart speed"] .read-outs li').length === 2,
  );
  assert.deepEqual(faults, []);
});

/** Three laps: one without its start, the best one, and a slower one with a gap that is driven. */
function laps(nowMs) {
  const at = (lap, endMs, more) => ({
    id: lap,
    number: lap,
    begin_ms: nowMs - 60_000 + lap,
    end_ms: endMs,
    time_s: null,
    start_seen: true,
    finish_seen: endMs !== null,
    gap_s: 0,
    ...more,
  });
  const table = {
    type: "laps",
    length_m: 500,
    step_m: 5,
    best: 2,
    laps: [
      at(1, nowMs - 50_000, { start_seen: false }),
      at(2, nowMs - 40_000, { time_s: 10 }),
      at(3, null, { gap_s: 2 }),
    ],
  };
  const columns = (secondsAPoint, silent) => {
    const known = (value) =>
      Array.from({ length: 100 }, (_, i) => (i > silent[0] && i < silent[1] ? NaN : value(i)));
    return [known((i) => i * secondsAPoint), ...Array.from({ length: 4 }, () => known(() => 1))];
  };
  const points = { 1: columns(0.2, [0, 0]), 2: columns(0.1, [0, 0]), 3: columns(0.102, [40, 60]) };
  return { table, points };
}

test("a lap is compared with a reference, place by place", async () => {
  const { table, points } = laps(stage.double.nowMs());
  stage.double.greetings = [table];
  stage.double.laps = points;
  const { page, faults } = await stage.open({ hash: "#/plots" });
  delete stage.double.greetings;
  await page.locator('.plots label:has-text("over") select').selectOption("laps");
  const delta = (what, text) =>
    until(
      page,
      what,
      (wanted) => {
        const chart = document.querySelector('[aria-label^="laps compared: time"]');
        return chart?.querySelector(".read-outs")?.textContent === wanted;
      },
      text,
    );
  await delta("the time lost at the end of the lap", "lap 3+0.198 s");
  assert.deepEqual(await page.locator(".lap-table tbody .time").allTextContents(), [
    "not finished, gap of 2.0 s",
    "0:10.000",
    "incomplete: start not seen",
  ]);
  const gap = await page.evaluate(() => {
    const { laps: store } = globalThis.pitwall.session.shownCar.value;
    return store.points(3).columns.time.slice(39, 62).filter(Number.isNaN).length;
  });
  assert.equal(gap, 19, "what was not received is not there");
  await page.screenshot({ path: join(kScreenshots, "laps_compared.png") });
  await page.click('[aria-label="compare with lap 3"]');
  await delta("no difference to itself", "lap 30.000 s");
  await page.click('button:has-text("Against the best")');
  await page.click('[aria-label="show lap 1"]');
  await delta("why there is none", "the start of lap 1 was not seen\u2013");
  await page.locator('.plots label:has-text("over") select').selectOption("time");
  assert.deepEqual(faults, []);
});

test("an attempt that the car declines, and the fuel that it declines by", async () => {
  const { labels } = stage.double.catalogue.fields.find((f) => f.path === "planner.reason");
  stage.double.set("planner.reason", labels.indexOf("declined: fuel"));
  stage.double.set("derived.fuel_attempts", 0);
  stage.double.set("fuel.laps_left", 2.6);
  const { page } = await stage.open({ hash: "#/race" });
  const digits = (path) => page.textContent(`.race-page [data-path="${path}"] .digits`);
  await until(page, "why it is no faster", () =>
    /DECLINED.*fuel/.test(document.querySelector('[data-path="planner.reason"]').textContent),
  );
  assert.equal(await digits("derived.fuel_attempts"), "0");
  assert.equal(await digits("fuel.laps_left"), "2.6");
  await page.screenshot({ path: join(kScreenshots, "declined.png") });
});
