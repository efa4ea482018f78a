/**
 * How long a critical value takes from the base's socket to the screen: the double sends the number
 * of the sample as the round's speed, the page notes when it is in the document and the frame after
 * that begins. A sample that was overtaken counts until a later one is drawn. Prints one JSON
 * object; a measurement, not a test, because other work shares the machine.
 *
 *   node pixel_latency.mjs [SAMPLES]
 */
// SPDX-License-Identifier: Apache-2.0
import { Double } from "./double.mjs";
import { launch, open } from "./stage.mjs";

const kSamples = Number(process.argv[2] ?? 200);
const kMphPerMps = 2.2369362920544;
const kPath = "flags.round_target_speed";

const now = () => performance.timeOrigin + performance.now();
const rounded = (ms) => Math.round(ms * 10) / 10;

const browser = await launch();
const double = new Double();
const { page } = await open(browser, await double.listen());
await page.evaluate((path) => {
  globalThis.drawn = [];
  const digits = document.querySelector(`[data-path="${path}"] .digits`);
  new MutationObserver(() => {
    const number = Number(digits.textContent);
    requestAnimationFrame(() =>
      globalThis.drawn.push([number, performance.timeOrigin + performance.now()]),
    );
  }).observe(digits, { childList: true, characterData: true, subtree: true });
}, kPath);

const sent = [];
for (let n = 0; n < kSamples; ++n) {
  double.set(kPath, (1000 + n) / kMphPerMps);
  sent.push(now());
  double.tick();
  await new Promise((done) => setTimeout(done, 60 + 17 * Math.random()));
}
await page.waitForTimeout(1000);
const drawn = await page.evaluate(() => globalThis.drawn);
const ms = sent
  .map((when, n) => drawn.find(([number]) => number >= 1000 + n)?.[1] - when)
  .filter(Number.isFinite)
  .sort((a, b) => a - b);
const at = (share) => rounded(ms[Math.min(Math.floor(share * ms.length), ms.length - 1)]);
console.log(
  JSON.stringify({
    samples: kSamples,
    drawn: ms.length,
    p50_ms: at(0.5),
    p95_ms: at(0.95),
    max_ms: at(1),
  }),
);
await browser.close();
await double.close();
