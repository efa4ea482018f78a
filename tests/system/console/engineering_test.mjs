/**
 * What an engineer reads: the event log as it grows, with its filters and its file, and every field
 * by the name and in the unit of the trade on plots, in the table of telemetry and in the finder.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { doubleStage, kDeskSizes, kScreenshots, until } from "./stage.mjs";

const stage = doubleStage();

const kMiles = 2.2369362920544;
const kLines = 300;

/** A line of each kind; the car's last word is the newest. */
function history(now) {
  return [
    { type: "event", time_ms: now - 9000, text: "lap 3: 38.420 s", severity: "info" },
    { type: "alarm_event", time_ms: now - 8000, key: "alarm_2", from: "normal", to: "unack" },
    { type: "alarm_event", time_ms: now - 7000, key: "oil_low", from: "normal", to: "latched" },
    { type: "audit", time_ms: now - 6000, who: "Ada", what: "speed limit 62.1 m/s", result: "ok" },
    { type: "mark", time_ms: now - 5000, text: "bump in T3", by: "Ada" },
    { type: "event", time_ms: now - 4000, text: "fault: brake\ttoo hot", severity: "warning" },
  ];
}

const alarmsWith = (text) => ({
  type: "alarms",
  revision: 1,
  kpi: { per_10_min: 0, flood: false },
  active: [
    { id: 2, key: "alarm_2", text, response: "", priority: "low", state: "unack", since_ms: 0 },
  ],
  shelved: [],
  suppressed: [],
});

const car = (timeMs, text) => ({ type: "event", time_ms: timeMs, text, severity: "info" });

/** The rows in sight as their cells, from the top. */
const rows = () =>
  [...document.querySelectorAll(".event-row")]
    .sort((a, b) => parseFloat(a.style.top) - parseFloat(b.style.top))
    .map((row) => [...row.children].map((cell) => cell.textContent));

/** The text of the row at the top edge of the box, and how far it stands from it. */
const topRow = () => {
  const box = document.querySelector(".event-box");
  const edge = box.getBoundingClientRect().top;
  const row = [...document.querySelectorAll(".event-row")].find(
    (e) => e.getBoundingClientRect().bottom > edge + 1,
  );
  return [row.textContent, Math.round(row.getBoundingClientRect().top - edge)];
};

const counted = (page, text) =>
  until(page, text, (t) => document.querySelector(".count-of")?.textContent === t, text);

async function openEvents(options) {
  stage.double.greetings = [
    alarmsWith("Tyres cold: 74.0 degC"),
    ...history(stage.double.nowMs()),
    ...(stage.double.greetings ?? []),
  ];
  return stage.open({ hash: "#/events", ready: ".event-row", ...options });
}

for (const size of kDeskSizes) {
  test(`${size.join(" x ")}: events of all sources, newest first, live`, async () => {
    const { page, faults } = await openEvents({ size });
    await counted(page, "6 of 6");
    const drawn = await page.evaluate(rows);
    assert.deepEqual(
      drawn.map(([, ...cells]) => cells),
      [
        ["car", "warning", "fault: brake\ttoo hot"],
        ["operator", "mark", "Ada: bump in T3"],
        ["operator", "ok", "Ada: speed limit 138.9 mph"],
        ["alarm", "latched", "oil low"],
        ["alarm", "new", "Tyres cold: 74.0 \u00b0C"],
        ["car", "info", "lap 3: 38.420 s"],
      ],
    );
    for (const [utc] of drawn) assert.match(utc, /^19:0[34]:\d\d\.\d$/);
    await page.screenshot({ path: join(kScreenshots, `event_log_${size[0]}.png`) });
    stage.double.say(car(stage.double.nowMs(), "mode: driving -> halted"));
    await counted(page, "7 of 7");
    assert.equal((await page.evaluate(rows))[0][3], "mode: driving -> halted");
    await page.keyboard.press("u");
    await until(page, "the other unit", () =>
      [...document.querySelectorAll(".event-row .what")].some((e) =>
        e.textContent.endsWith("223.6 km/h"),
      ),
    );
    assert.deepEqual(faults, []);
  });
}

test("key 0 opens the event log, and an empty one says so", async () => {
  const { page } = await stage.open();
  await page.keyboard.press("0");
  await until(page, "the page", () => location.hash === "#/events");
  await until(page, "what is not there yet", () =>
    document.querySelector(".events-page .empty")?.textContent.startsWith("Nothing yet"),
  );
  await page.keyboard.press("?");
  assert.match(await page.innerText(".help"), /1 \u2026 9, 0/);
});

test("events are filtered by source and by text", async () => {
  const { page } = await openEvents();
  const press = (source) => page.click(`.events-page button:text-is("${source}")`);
  await press("car");
  assert.equal(
    await page.getAttribute('.events-page button:text-is("car")', "aria-pressed"),
    "false",
  );
  await counted(page, "4 of 6");
  await press("alarm");
  await counted(page, "2 of 6");
  await page.fill('input[aria-label="filter events"]', "ada MPH");
  await counted(page, "1 of 6");
  assert.equal((await page.evaluate(rows))[0][3], "Ada: speed limit 138.9 mph");
  await page.fill('input[aria-label="filter events"]', "nothing of the kind");
  await counted(page, "0 of 6");
  assert.match(await page.innerText(".events-page .empty"), /No line passes/);
  assert.equal(await page.isDisabled('.events-page button:text-is("Save")'), true);
});

test("the file has the lines that pass the filter, tab-separated", async () => {
  const { page } = await openEvents();
  await page.click('.events-page button:text-is("alarm")');
  await counted(page, "4 of 6");
  const coming = page.waitForEvent("download");
  await page.click('.events-page button:text-is("Save")');
  const download = await coming;
  assert.equal(download.suggestedFilename(), "pitwall_events.tsv");
  const lines = (await readFile(await download.path(), "utf8")).trimEnd().split("\n");
  assert.equal(lines[0], "utc\tsource\tkind\twhat");
  assert.match(lines[1], /^2026-01-09T19:0[34]:\S+Z\tcar\twarning\tfault: brake too hot$/);
  assert.match(lines[3], /Z\toperator\tok\tAda: speed limit 62\.1 m\/s$/);
  assert.equal(lines.length, 5);
});

test("new lines do not move what is read further down", async () => {
  const now = stage.double.nowMs();
  stage.double.greetings = Array.from({ length: kLines }, (_, i) =>
    car(now - 1000 * (kLines - i), `line ${i}`),
  );
  const { page } = await openEvents();
  const all = kLines + 6;
  await counted(page, `${all} of ${all}`);
  assert.ok((await page.locator(".event-row").count()) <= 60, "rows out of sight do not exist");
  await page.evaluate(() => (document.querySelector(".event-box").scrollTop = 3217));
  await until(page, "further down", () => document.querySelector(".event-rows").children.length);
  await page.waitForTimeout(200);
  const before = await page.evaluate(topRow);
  for (let n = 1; n <= 20; ++n) stage.double.say(car(stage.double.nowMs(), `later ${n}`));
  await counted(page, `${all + 20} of ${all + 20}`);
  await page.waitForTimeout(200);
  assert.deepEqual(await page.evaluate(topRow), before);
  await page.evaluate(() => (document.querySelector(".event-box").scrollTop = 0));
  // Only when the page has seen the scrolling does its top follow what comes in.
  await until(
    page,
    "the newest",
    () => document.querySelector(".event-row .what").textContent === "later 20",
  );
  stage.double.say(car(stage.double.nowMs() + 1, "the newest"));
  await counted(page, `${all + 21} of ${all + 21}`);
  assert.match((await page.evaluate(topRow))[0], /the newest$/);
});

test("plots name their fields and give every value its unit, speeds in that of key U", async () => {
  const { page, faults } = await stage.open({ hash: "#/plots" });
  const speed = (unit) =>
    until(
      page,
      `speed in ${unit}`,
      (u) => {
        const cells = [...document.querySelectorAll('[aria-label="chart speed"] .read-outs li')];
        return cells.length === 2 && cells.every((e) => e.textContent.endsWith(` ${u}`));
      },
      unit,
    );
  await speed("mph");
  const readOuts = () =>
    [...document.querySelectorAll(".chart .read-outs li")].map((e) => [
      e.querySelector(".name").textContent,
      e.querySelector(".digits").textContent.replace(/^[\u2212\d.]+/, ""),
    ]);
  assert.deepEqual(await page.evaluate(readOuts), [
    ["speed", " mph"],
    ["target speed", " mph"],
    ["cross-track error", " m"],
    ["commanded steering angle", "\u00b0"],
    ["steering angle", "\u00b0"],
    ["commanded throttle", ""],
    ["throttle", ""],
    ["commanded brake pressure", " kPa"],
    ["front brake pressure", " kPa"],
    ["rear brake pressure", " kPa"],
    ["longitudinal acceleration", " m/s\u00b2"],
    ["lateral acceleration", " m/s\u00b2"],
  ]);
  await page.waitForTimeout(1500);
  await page.screenshot({ path: join(kScreenshots, "plots_named.png") });
  const value = async () =>
    parseFloat(await page.textContent('[aria-label="chart speed"] .read-outs .digits'));
  assert.ok(Math.abs((await value()) / kMiles - 62) < 2, "62 m/s in mph");
  await page.keyboard.press("u");
  await speed("km/h");
  assert.ok(Math.abs((await value()) / 3.6 - 62) < 2, "62 m/s in km/h");
  await page.keyboard.press("u");
  await speed("m/s");
  assert.ok(Math.abs((await value()) - 62) < 2);
  assert.deepEqual(faults, []);
});

test("the axis of a chart has the unit that is shown", async () => {
  const { page } = await stage.open({ hash: "#/plots" });
  await page.evaluate(() => {
    globalThis.drawn = new Set();
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
      globalThis.drawn.add(text);
      return fillText.call(this, text, ...rest);
    };
  });
  const has = (text) => globalThis.drawn.has(text);
  for (const unit of ["mph", "m", "\u00b0", "kPa", "m/s\u00b2"]) await until(page, unit, has, unit);
  await page.keyboard.press("u");
  await until(page, "km/h", has, "km/h");
  await until(page, "a tick of 62 m/s in km/h", () =>
    [...globalThis.drawn].some((text) => /^22\d/.test(text)),
  );
});

test("the table of telemetry names each field, and is filtered by name and by path", async () => {
  const { page } = await stage.open({ hash: "#/telemetry", size: [1280, 800] });
  await page.screenshot({ path: join(kScreenshots, "telemetry_named.png") });
  const row = () => {
    const cells = [...document.querySelectorAll(".field-row")].map((e) => e.children);
    if (cells.length !== 1) return null;
    const [named, value, , , least, most] = cells[0];
    return {
      title: named.querySelector("b").textContent,
      path: named.querySelector(".path").textContent,
      value: value.querySelector(".digits").textContent,
      unit: value.querySelector(".unit").textContent,
      least: least.textContent,
      most: most.textContent,
    };
  };
  const only = async (query, path) => {
    await page.fill("input[type=search]", query);
    await until(
      page,
      `${path} alone`,
      (wanted) => {
        const paths = [...document.querySelectorAll(".field-row .path")];
        const [least] = document.querySelectorAll(".field-row .number:nth-child(5)");
        return (
          paths.length === 1 && paths[0].textContent === wanted && /\d/.test(least?.textContent)
        );
      },
      path,
    );
    return page.evaluate(row);
  };
  const byName = await only("wheel speed front left", "wheels.front_left");
  assert.equal(byName.title, "wheel speed front left");
  assert.equal(byName.unit, "mph");
  for (const text of [byName.value, byName.least, byName.most]) {
    assert.ok(Math.abs(parseFloat(text) / kMiles - 62) < 2, `${text} mph`);
  }
  await page.focus(".field-box");
  await page.keyboard.press("u");
  await until(
    page,
    "km/h",
    () => document.querySelector(".field-row .unit").textContent === "km/h",
  );
  await until(page, "the least in km/h", () =>
    /^2[12]\d/.test(document.querySelector(".field-row .number:nth-child(5)").textContent),
  );
  assert.equal((await only("dynamics.left", "dynamics.left")).unit, "m/s\u00b2");
  const steering = await only("feedback.steering", "feedback.steering");
  assert.deepEqual([steering.title, steering.unit], ["steering angle", "\u00b0"]);
});

test("the finder finds by name and by path, shows both and the value with its unit", async () => {
  const { page } = await stage.open();
  await page.keyboard.press("/");
  await page.keyboard.type("cross-track");
  const first = () => {
    const option = document.querySelector('.finder li[aria-selected="true"]');
    return ["title", "path", "digits", "unit"].map(
      (name) => option?.querySelector(`.${name}`)?.textContent ?? "",
    );
  };
  await until(page, "a value", () => document.querySelector(".finder .value .digits"));
  const found = await page.evaluate(first);
  assert.deepEqual(
    [found[0], found[1], found[3]],
    ["cross-track error", "dynamics.lateral_error", "m"],
  );
  await page.keyboard.press("Control+A");
  await page.keyboard.type("ego.vx");
  await until(page, "the speed", () =>
    /^1[34]\d/.test(document.querySelector('.finder [aria-selected="true"] .digits')?.textContent),
  );
  const speed = await page.evaluate(first);
  assert.deepEqual([speed[0], speed[1], speed[3]], ["speed", "ego.vx", "mph"]);
  await page.screenshot({ path: join(kScreenshots, "finder_named.png") });
  await page.keyboard.press("Control+A");
  await page.keyboard.type("coolant");
  await page.keyboard.press("Enter");
  await until(
    page,
    "the chart",
    () =>
      location.hash === "#/plots" &&
      document.querySelector('[aria-label="chart coolant temperature"] canvas'),
  );
});

test("the race page has each tracked rival, and says what was not heard lately", async () => {
  const { page } = await stage.open({ hash: "#/race" });
  const table = () =>
    [...document.querySelectorAll('[aria-label="tracked rivals"] tbody tr')].map((row) =>
      [...row.querySelectorAll(".value")].map((e) => [
        e.querySelector(".digits").textContent,
        e.dataset.quality,
      ]),
    );
  await until(page, "three rivals", () => {
    const names = document.querySelectorAll('[aria-label="tracked rivals"] th .digits');
    return [...names].map((e) => e.textContent).join() === "12,31,45,\u2013";
  });
  const [first, second, third, fourth] = await page.evaluate(table);
  assert.equal(first[2][0], "4.5", "the offset");
  assert.equal(second[4][0], "0.1", "the time since its detection");
  assert.ok(Number(third[5][0]) >= 0.4, `a sigma of ${third[5][0]}`);
  assert.equal(fourth[1][1], "never");
  stage.double.silence();
  await until(page, "old values", () =>
    [...document.querySelectorAll('[aria-label="tracked rivals"] td .value')].every((e) =>
      ["stale", "never"].includes(e.dataset.quality),
    ),
  );
});
