/**
 * A base and a car that go by bench time, and a bench that lets it stand: the console says that
 * the bench waits and takes nothing for old or lost meanwhile, goes on with it, and says for how
 * long it stood in all. A base that is stopped itself does not answer, whatever its time does.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { join } from "node:path";
import { kRoot } from "./packages.mjs";
import { Programs } from "./programs.mjs";
import { kScreenshots, launch, open, until } from "./stage.mjs";

const kKeeper =
  process.env.PITWALL_KEEPER ?? join(kRoot, "build/release/tests/system/console/bench_keeper");
const kStandsMs = 1000;
/** A base that was heard so lately is taken for silent (500 ms) in no frame drawn meanwhile. */
const kAnswersMs = 300;

let browser;
let programs;
let keeper;
let address;
let summary;
let screen = "";

before(async () => {
  browser = await launch();
  programs = new Programs();
  const clock = join(programs.folder, "clock");
  summary = join(programs.folder, "summary.json");
  process.env.PITWALL_TEST_CLOCK = clock;
  keeper = spawn(kKeeper, [clock], { stdio: ["pipe", "pipe", "inherit"] });
  await once(keeper.stdout, "data");
  address = await programs.startBase(
    ...["--clock", clock, "--json", summary, "--text", "--plain", "--car-name", "Caracara"],
  );
  programs.base.stdout.on("data", (part) => (screen += part));
  programs.startCar();
});
after(async () => {
  keeper?.kill("SIGKILL");
  await programs.close();
  await browser.close();
});

const waits = () => document.querySelector(".bench-time")?.dataset.waits === "true";
const goesOn = () => document.querySelector(".bench-time")?.dataset.waits === "false";
const linkIs = (pattern) =>
  new RegExp(pattern).test(document.querySelector(".link-tile .word").textContent);

/**
 * In the page: what each drawn frame says from now on, told apart, as long as the base answers. On
 * a machine with other work it may itself be without a processor for long enough to be silent.
 */
const watchFrames = (answersMs) => {
  const text = (selector) => document.querySelector(selector).textContent;
  const { clock } = globalThis.pitwall.session;
  const seen = { links: new Set(), qualities: new Set() };
  globalThis.seenFrames = seen;
  let answered = false;
  const look = () => {
    const answers = clock.silenceMs(performance.now()) < answersMs;
    if (answers && answered) {
      seen.links.add(text(".link-tile .word").split(" ")[0]);
      seen.qualities.add(document.querySelector('[data-path="ego.vx"]').dataset.quality);
    }
    answered = answers;
    requestAnimationFrame(look);
  };
  look();
};
const seenFrames = () =>
  Object.fromEntries(Object.entries(globalThis.seenFrames).map(([key, set]) => [key, [...set]]));
/**
 * In the page: the base's time, by which ages are counted, and how long it is said to stand (null:
 * it goes on); of a moment at which the base answers, and its time has stood for `leastMs`.
 */
const times = (leastMs) => {
  const { clock } = globalThis.pitwall.session;
  const at = performance.now();
  const pauseMs = clock.pauseMs(at);
  if (clock.isSilent(at) || (pauseMs ?? 0) < leastMs) return null;
  return { baseMs: clock.nowMs(at), pauseMs };
};

test("while bench time stands the console says so, and nothing is old or lost", async () => {
  const { page, faults } = await open(browser, address);
  await until(page, "the link", linkIs, "GOOD");
  await until(page, "the time of a bench", goesOn);
  await until(page, "the speed", () =>
    document.querySelector('[data-path="ego.vx"][data-quality="fresh"]'),
  );
  assert.match(await page.innerText(".bench-time"), /^bench time, stood \d/);
  await page.evaluate(watchFrames, kAnswersMs);

  keeper.stdin.write("stand\n");
  await until(page, "the notice", waits);
  const first = await until(page, "how long so far", times, 1);
  const last = await until(page, "its pause growing", times, first.pauseMs + kStandsMs);
  assert.ok(Math.abs(last.baseMs - first.baseMs) < 1, "its time stands");
  await until(page, "for how long", () =>
    /^bench waits [1-9]\d*\.\d s$/.test(document.querySelector(".bench-time").innerText),
  );
  const seen = await page.evaluate(seenFrames);
  assert.deepEqual(seen.links, ["GOOD"]);
  assert.deepEqual(seen.qualities, ["fresh"]);
  for (const size of [1920, 1280, 1024]) {
    await page.setViewportSize({ width: size, height: 800 });
    await page.screenshot({ path: join(kScreenshots, `bench_waits_${size}.png`) });
  }

  keeper.stdin.write("go\n");
  await until(page, "its end", goesOn);
  await until(page, "how long in all", () =>
    /stood [1-9]/.test(document.querySelector(".bench-time").innerText),
  );
  await until(page, "the link", linkIs, "GOOD");
  const then = await until(page, "its time", times, 0);
  assert.ok(then.baseMs > last.baseMs && then.baseMs < last.baseMs + 10_000, "from where it stood");
  assert.deepEqual(faults, []);
  assert.match(screen, /TIME +BENCH WAITS, \d+\.\d s now, \d+\.\d s in all/);
  await page.screenshot({ path: join(kScreenshots, "bench_time.png") });

  const metrics = await (await fetch(`${address}/metrics`)).text();
  const [, stood_s] = /^pitwall_bench_time_stood_seconds_total (\S+)$/m.exec(metrics);
  assert.ok(Number(stood_s) >= kStandsMs / 1000, stood_s);
});

test("who comes while it stands is told, and a base that is stopped does not answer", async () => {
  keeper.stdin.write("stand\n");
  const { page } = await open(browser, address);
  await until(page, "the notice", waits);
  programs.base.kill("SIGSTOP");
  await until(page, "no base", linkIs, "^NO BASE");
  await until(page, "no notice of what nobody says", goesOn);
  const alive = () => document.querySelectorAll('.value:is([data-quality="fresh"])').length;
  await until(page, "nothing looks alive", () =>
    [...document.querySelectorAll(".value")].every(
      (e) => !["fresh", "late"].includes(e.dataset.quality),
    ),
  );
  assert.equal(await page.evaluate(alive), 0);
  programs.base.kill("SIGCONT");
  await until(page, "the notice again", waits);
  keeper.stdin.write("go\n");
  await until(page, "its end", goesOn);
  await until(page, "fresh values", () => document.querySelector('[data-quality="fresh"]'));
});

test("the summary of the run says for how long it stood", async () => {
  assert.equal(programs.base.exitCode, null, programs.baseSaid);
  programs.base.kill("SIGCONT");
  programs.base.kill("SIGTERM");
  await once(programs.base, "exit");
  const { bench_time: time } = JSON.parse(readFileSync(summary, "utf8"));
  assert.ok(time.stood_s >= kStandsMs / 1000, JSON.stringify(time));
});
