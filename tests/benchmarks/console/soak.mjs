/**
 * The console for a long time: a browser with 24 charts on a car that says all it can, beside a
 * console whose process is stopped. Memory of both ends, and how soon a tab that slept is live.
 *
 *   node soak.mjs [--json FILE]   exit code 1 when a gate is missed
 *
 * PITWALL_SOAK_MINUTES is its length (30); PITWALL_BASE and PITWALL_CAR name the programs. A page
 * keeps ten minutes of every field: its memory is judged from when those are full, which a run of
 * less than 25 minutes does not wait for.
 */
// SPDX-License-Identifier: Apache-2.0
import { spawn } from "node:child_process";
import { once } from "node:events";
import { fileURLToPath } from "node:url";
import { launch, open } from "../../system/console/stage.mjs";
import { judged } from "./gates.mjs";
import { Rig, eventually, kNumberPath, now, pause, quantile } from "./rig.mjs";

const kMinuteMs = 60_000;
const kMinutes = Number(process.env.PITWALL_SOAK_MINUTES ?? 30);
const kJudged = kMinutes >= 25;
const kFillMs = Math.min(11, kMinutes * 0.4) * kMinuteMs;
const kSleepMs = Math.min(5, kMinutes * 0.2) * kMinuteMs;
const kWatchMs = kMinutes * kMinuteMs - kFillMs - kSleepMs;
const kSamples = 30;
const kReadings = 5;
const kBetweenMs = 700;
const kCharts = 24;
const kBytesPerMb = 1024 * 1024;
// Of a quarter of an hour, beside the base's hour of history, which has a bound of its own. What
// waits for a console that does not read would be 6 MB a minute if nothing bounded it.
const kMostGrownMb = 6;

/** Median of the slopes between all pairs: one collection that came late does not tilt it. */
function slope(points) {
  const slopes = points.flatMap(({ at, value }, i) =>
    points.slice(i + 1).map((later) => (later.value - value) / (later.at - at)),
  );
  return quantile(slopes, 0.5);
}

/** Stores a layout of 24 charts, as an operator would have made it. */
async function chart(rig) {
  const fields = rig.fields.filter(({ kind }) => kind === "real").slice(0, 2 * kCharts);
  const charts = Array.from({ length: kCharts }, (_, i) => ({
    title: fields[2 * i].path,
    fields: [fields[2 * i].path, fields[2 * i + 1].path],
  }));
  const body = JSON.stringify({ version: 1, window_s: 60, charts });
  const stored = await fetch(`${rig.address}/api/layouts/plots`, { method: "PUT", body });
  if (!stored.ok) throw new Error(`the layout is refused: ${stored.status}`);
}

/** A console whose process stands still from now on. */
async function stoppedConsole(rig) {
  const script = fileURLToPath(new URL("sleeper.mjs", import.meta.url));
  const console = spawn(process.execPath, [script, rig.address], { stdio: ["ignore", "pipe", 2] });
  await once(console.stdout, "data");
  console.kill("SIGSTOP");
  return console;
}

/**
 * Heap and buffers of the page in MB, after a collection: the least of some readings, as a picture
 * that has just come in is nothing that the page keeps.
 */
async function heapMb(devtools) {
  const readings = [];
  for (let n = 0; n < kReadings; ++n) {
    if (n > 0) await pause(kBetweenMs);
    await devtools.send("HeapProfiler.collectGarbage");
    const heap = await devtools.send("Runtime.getHeapUsage");
    readings.push((heap.usedSize + (heap.backingStorageSize ?? 0)) / kBytesPerMb);
  }
  return Math.min(...readings);
}

/** How many frames the page drew in this time, and the longest that most of them took. */
const frames = (page, ms) =>
  page.evaluate(
    (length) =>
      new Promise((done) => {
        const took = [];
        let last = performance.now();
        const end = last + length;
        const frame = () => {
          const at = performance.now();
          took.push(at - last);
          last = at;
          if (at < end) requestAnimationFrame(frame);
          else done(took);
        };
        requestAnimationFrame(frame);
      }),
    ms,
  );

/** Of alarms, people and the car: a list is bounded, and grows until it is full. */
const lines = (page) =>
  page.evaluate(() => {
    const { alarmEvents, audit, carEvents } = globalThis.pitwall.session;
    return alarmEvents.value.length + audit.value.length + carEvents.value.length;
  });

async function watchMemory(gates, rig, page, devtools) {
  gates.say("lines that the page keeps, at first", await lines(page), "");
  const heap = [];
  const resident = [];
  const busy = rig.busyMs();
  const from = now();
  for (let n = 0; n < kSamples; ++n) {
    await pause(kWatchMs / kSamples - (kReadings - 1) * kBetweenMs);
    heap.push({ at: now(), value: await heapMb(devtools) });
    resident.push({ all: rig.residentMb(), history: await rig.historyMb() });
  }
  gates.say("base, share of a core", ((rig.busyMs() - busy) / (now() - from)) * 100, "%");
  gates.say("a frame with 24 charts, p95", quantile(await frames(page, 10_000), 0.95), "ms");
  gates.say("lines that the page keeps, at last", await lines(page), "");
  console.log(`heap, MB: ${heap.map(({ value }) => value.toFixed(2)).join(" ")}`);
  const grows = slope(heap) * 60 * kMinuteMs;
  if (kJudged) gates.ask("heap of the page grows by", grows, 1, "MB/h");
  else gates.say("heap of the page grows by, history not full", grows, "MB/h");
  gates.ask("heap of the page", heap.at(-1).value, 150, "MB");
  return resident;
}

/** A tab that the browser froze: from waking it to a number that left after that on the screen. */
async function sleep(gates, rig, page, devtools) {
  await page.evaluate(() => (location.hash = "#/primary"));
  const selector = `[data-path="${kNumberPath}"] .digits`;
  await page.waitForSelector(selector);
  await devtools.send("Page.setWebLifecycleState", { state: "frozen" });
  await pause(kSleepMs);
  const { number } = rig.newest;
  const woken = now();
  await devtools.send("Page.setWebLifecycleState", { state: "active" });
  await eventually("the newest number", async () => {
    const drawn = Number(await page.textContent(selector));
    return (drawn - number + 180) % 180 < 90;
  });
  gates.ask("a tab that slept is live after", now() - woken, 500, "ms");
}

await judged("console-soak", async (gates) => {
  console.log(`${kMinutes} minutes, ${Math.round(kFillMs / kMinuteMs)} of them to fill histories`);
  const rig = new Rig();
  const browser = await launch();
  let stopped;
  try {
    await rig.start(kMinutes * 60 + 300);
    await chart(rig);
    const { page, faults } = await open(browser, rig.address, { hash: "#/plots" });
    const devtools = await page.context().newCDPSession(page);
    await devtools.send("HeapProfiler.enable");
    stopped = await stoppedConsole(rig);
    const charts = await page.locator(".uplot").count();
    gates.ask("charts that are missing", kCharts - charts, 0, "");
    await pause(kFillMs);
    const resident = await watchMemory(gates, rig, page, devtools);
    const [first, last] = [resident[0], resident.at(-1)];
    gates.say("memory of the base", last.all, "MB");
    gates.say("of which history", last.history, "MB");
    gates.say("history grows by", last.history - first.history, "MB");
    const grown = last.all - first.all - (last.history - first.history);
    gates.ask("memory of the base grows besides by", grown, kMostGrownMb, "MB");
    await sleep(gates, rig, page, devtools);
    gates.ask("faults that the page told", faults.length, 0, "");
    if (faults.length > 0) console.log(faults.slice(0, 5).join("\n"));
  } finally {
    stopped?.kill("SIGKILL");
    await browser.close();
    await rig.close();
  }
});
