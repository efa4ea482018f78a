/**
 * What the console shows of a recording is what it showed live: the same car, recorded by the real
 * base and played by another process of it, read at the same moments of the log.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { pass } from "../../support/test_clock.mjs";
import { baseStage, show, until } from "./stage.mjs";

/** Of the recording that is played again and again, however long that is. */
const kPieceMs = 1000;
const stage = baseStage({ flags: (programs) => ["--record", join(programs.folder, "recording")] });

/** Every field as the page has it, and the base's time of the newest frame. */
const fieldsNow = () => {
  const { info, value, status, entryMs } = globalThis.pitwall.session.fields.value;
  const rows = info.map((field, slot) => [field.path, [value[slot], status[slot]]]);
  return { atMs: Math.max(...entryMs), rows: Object.fromEntries(rows) };
};

/** The words and digits of the page, by field. */
const drawnNow = () =>
  Object.fromEntries(
    [...document.querySelectorAll(".value[data-path]")].map((e) => [
      e.dataset.path,
      [e.querySelector(".digits")?.textContent, e.dataset.quality, e.dataset.judgement],
    ]),
  );

/** Keeps every text that is drawn on a canvas from now on. */
const watchCanvas = () => {
  globalThis.drawn = new Set();
  const { fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
    globalThis.drawn.add(text);
    return fillText.call(this, text, ...rest);
  };
};

/** What differs between two maps of fields. */
const different = (live, again) =>
  Object.keys(live)
    .filter((path) => live[path].some((part, i) => !Object.is(part, again[path]?.[i])))
    .map((path) => `${path}: ${live[path]} live, ${again[path]} again`);

async function jump(page, atMs) {
  await page.evaluate((to) => {
    const socket = new WebSocket(`ws://${location.host}/ws`);
    socket.onopen = () => socket.send(JSON.stringify({ type: "playback", speed: 0, to_ms: to }));
  }, atMs);
  await until(
    page,
    "the replay at that time",
    (to) => Math.abs(globalThis.pitwall.session.playback.value?.now_ms - to) < 0.01,
    atMs,
  );
}

/** To the time of a sample. */
async function seek(page, atMs) {
  await jump(page, atMs);
  await until(
    page,
    "its values",
    (to) => {
      const { playback, fields } = globalThis.pitwall.session;
      const newest = Math.max(...fields.value.entryMs);
      return Math.abs(playback.value?.now_ms - to) < 0.01 && Math.abs(newest - to) < 0.01;
    },
    atMs,
  );
}

test("the same moment of the log has the same fields, live and from the file", async () => {
  const { page } = await stage.open();
  await until(page, "a link", () =>
    /GOOD|DEGRADED/.test(document.querySelector(".link-tile .word").textContent),
  );
  const moments = [];
  for (let n = 0; n < 3; ++n) {
    await page.waitForTimeout(300);
    moments.push(await page.evaluate(fieldsNow));
  }
  await stage.programs.kill("car");
  await until(page, "a lost link", () =>
    /LOST/.test(document.querySelector(".link-tile .word").textContent),
  );
  let drawn;
  for (let before; !drawn || different(before, drawn).length > 0;) {
    before = await page.evaluate(drawnNow);
    await pass(2500); // everything is stale
    await page.waitForTimeout(1500); // and drawn so
    drawn = await page.evaluate(drawnNow);
  }
  const lost = await page.evaluate(fieldsNow);
  const alarms = await page.evaluate(() =>
    globalThis.pitwall.session.alarms.value.active.map(({ key, state }) => [key, state]),
  );
  await page.waitForTimeout(600); // on the disk
  await stage.programs.kill("base");

  const address = await stage.programs.startReplay(join(stage.programs.folder, "recording"));
  await page.goto(`${address}/`);
  await until(page, "the replay", () => globalThis.pitwall?.session.playback.value);
  await page.evaluate(watchCanvas);
  for (const { atMs, rows } of moments) {
    await seek(page, atMs);
    const again = await page.evaluate(fieldsNow);
    assert.deepEqual(different(rows, again.rows), [], `at ${atMs} ms`);
  }
  assert.equal(moments.at(-1).rows["opponent_1.station"][0], 400);
  await until(page, "the opponent on the map", () => globalThis.drawn.has("#3"));
  await seek(page, lost.atMs);
  assert.deepEqual(different(lost.rows, (await page.evaluate(fieldsNow)).rows), []);
  let left = ["not drawn"];
  for (let n = 0; n < 50 && left.length > 0; ++n) {
    await page.waitForTimeout(100); // the digits are drawn four times a second
    left = different(drawn, await page.evaluate(drawnNow));
  }
  assert.deepEqual(left, []);
  const alarmsAgain = await page.evaluate(() =>
    globalThis.pitwall.session.alarms.value.active.map(({ key, state }) => [key, state]),
  );
  assert.deepEqual(alarmsAgain, alarms);
  assert.ok(alarms.length > 0, "the lost link is an alarm");
});

test("before a run: the base's check list, and the recording that it makes", async () => {
  const { page, faults } = await stage.open({ hash: "#/commands" });
  const verdict = ([name, wanted]) =>
    [...document.querySelectorAll(".check")].some(
      (e) => e.querySelector(".name").textContent === name && e.dataset.verdict === wanted,
    );
  await show(page, "replay");
  await until(page, "twelve items", () => document.querySelectorAll(".check").length === 12);
  await until(page, "nobody commands", verdict, ["authority", "no-go"]);
  await until(page, "it records", verdict, ["disk", "go"]);
  await until(page, "the car never told its tyres", verdict, ["tyres", "no-go"]);
  await show(page, "commands");
  await page.click("text=Take authority");
  await show(page, "replay");
  await until(page, "somebody commands", verdict, ["authority", "go"]);
  await until(page, "the recording", () =>
    document.querySelector(".recordings tbody")?.textContent.includes("being recorded"),
  );
  await page.click(".recordings tbody button");
  const folder = join(stage.programs.folder, "recording");
  assert.equal(
    await page.inputValue(".command-line input"),
    `pitwall-base --replay ${folder} --web 0 --track lvms`,
  );
  await stage.programs.kill("car");
  await until(page, "a lost link", verdict, ["link", "no-go"]);
  assert.deepEqual(faults, []);

  await page.waitForTimeout(600); // on the disk
  await stage.programs.kill("base");
  const address = await stage.programs.startReplay(folder);
  await page.goto(`${address}/#/replay`);
  await until(page, "the moments", () => document.querySelector(".moments"));
  assert.equal(await page.locator(".checklist").count(), 0, "no car, nothing to check");
  await until(page, "the replay", () => globalThis.pitwall.session.playback.value);
  const end = await page.evaluate(() => globalThis.pitwall.session.playback.value.end_ms);
  await seek(page, end);
  const people = '.moments li:has-text("authority") button';
  await until(page, "what people did", () =>
    document.querySelector(".moments ol").textContent.includes("authority"),
  );
  await page.locator(people).first().click();
  await until(
    page,
    "the moment before it",
    (last) => globalThis.pitwall.session.playback.value.now_ms < last,
    end,
  );

  const { begin, jumps } = await page.evaluate(() => {
    const { begin_ms, jumps } = globalThis.pitwall.session.playback.value;
    return { begin: begin_ms, jumps };
  });
  const from = begin + 0.3 * (end - begin);
  const to = from + kPieceMs;
  assert.ok(to < end, "the recording is longer than the piece");
  const loop = page.locator('.dvr-bar button[title*="again and again"]');
  for (const moment of [from, to]) {
    await jump(page, moment);
    await loop.click();
  }
  await page.locator('.dvr-bar button[aria-label="play"]').click();
  await until(
    page,
    "two turns",
    (most) => globalThis.pitwall.session.playback.value.jumps > most,
    jumps + 2 + 2, // of them two to set the marks
  );
  const now = await page.evaluate(() => globalThis.pitwall.session.playback.value.now_ms);
  assert.ok(now >= from - 1 && now < to + 1000, `${now} is within ${from} to ${to}`);
  assert.equal(await loop.getAttribute("aria-pressed"), "true");
  await loop.click();
  assert.equal(await loop.getAttribute("aria-pressed"), "false");
});
