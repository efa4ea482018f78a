/**
 * Three seconds without radio, as the emulated air makes them between a car and the real base: the
 * page says LOST, drafts one message that the link is bad and one that it is good again, in words
 * that race control can use.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { after, before, test } from "node:test";
import { join } from "node:path";
import { kRoot } from "./packages.mjs";
import { Programs } from "./programs.mjs";
import { launch, open, until } from "./stage.mjs";

const kLink =
  process.env.PITWALL_LINK ?? join(kRoot, "build/release/tests/system/console/radio_link");
const kSilentAfterS = 8;
const kSilentForS = 3;
const kLengthS = 60;
const kLateS = 0.3;

let browser;
let programs;
let link;

before(async () => {
  browser = await launch();
  programs = new Programs();
});
after(async () => {
  link?.kill("SIGKILL");
  await programs.close();
  await browser.close();
});

test("three seconds without radio are one draft, and its end another", async () => {
  const address = await programs.startBase();
  const port = programs.radio.split(":")[1];
  link = spawn(kLink, [port, kSilentAfterS, kSilentForS, kLengthS].map(String));
  const [said] = await once(link.stdout, "data");
  programs.radio = `127.0.0.1:${Number(said)}`;
  programs.startCar(kLengthS);
  const { page, faults } = await open(browser, address, { hash: "#/link" });
  const word = (text) =>
    until(
      page,
      text,
      (t) => document.querySelector(".link-tile .word").textContent.startsWith(t),
      text,
    );
  await word("GOOD");
  await word("LOST");
  await word("GOOD");
  const drafts = () =>
    page.evaluate(() =>
      [...document.querySelectorAll(".notice")].map((notice) =>
        [...notice.querySelectorAll("h3, p")].map((e) => e.textContent),
      ),
    );
  // A busy machine delays packets, too, for less; the base tells of that before or after. The last
  // packet before the silence may itself have come late: what the base hears can be a little less.
  const isEnd = ([, , had]) => {
    const longest = /^was lost; longest silence (\d+\.\d\d) s, worst loss \d+ %, /.exec(had);
    return Number(longest?.[1]) > kSilentForS - kLateS;
  };
  for (let n = 0; n < 100 && !(await drafts()).some(isEnd); ++n) await page.waitForTimeout(100);
  const told = await drafts();
  assert.equal(told.filter(isEnd).length, 1, JSON.stringify(told, null, 1));
  const end = told.findIndex(isEnd);
  const [degraded, bad, was] = told.slice(0, end).findLast(([, text]) => /is lost/.test(text));
  const [restored, good] = told[end];
  assert.match(degraded, /radio degraded$/);
  assert.match(restored, /radio restored$/);
  assert.equal(
    bad,
    "Radio to our car is lost. Car, when last heard: driving. If the silence lasts it makes a " +
      "controlled stop by itself.",
  );
  assert.match(was, /^silence 0\.\d\d s, loss \d+ %, round trip \d+ ms$/);
  assert.match(good, /^Radio to our car is good again after \d+\.\d s\. Car: driving\.$/);
  assert.deepEqual(faults, []);
});
