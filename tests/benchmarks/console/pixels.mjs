/**
 * From the car's packet to the pixel, in a real browser on the real base: the page notes when a
 * number is in the document and the frame after that begins.
 */
// SPDX-License-Identifier: Apache-2.0
import { launch, open } from "../../system/console/stage.mjs";
import { happenings, windows, withDelays } from "./blocks.mjs";
import { eventually, kNumberPath, now, pause } from "./rig.mjs";

/** Of each block. */
const kWindows = 2;
const kSettleMs = 3000;
const kSilences = 2;

/** In the page: notes each text of `selector` with the time of the frame that shows it. */
function watch([name, selector]) {
  const element = document.querySelector(selector);
  globalThis[name] = [];
  new MutationObserver(() => {
    const text = element.textContent;
    requestAnimationFrame(() => globalThis[name].push({ text, at: performance.now() }));
  }).observe(element, { childList: true, characterData: true, subtree: true });
}

/** What the page's clock is behind ours: of many questions the one that was answered soonest. */
async function clockOffset(page) {
  let best = { took: Infinity };
  for (let n = 0; n < 30; ++n) {
    const asked = now();
    const theirs = await page.evaluate(() => performance.now());
    const took = now() - asked;
    if (took < best.took) best = { took, offset: asked + took / 2 - theirs };
  }
  return best.offset;
}

/** ms from the last packet of a car that falls silent until the page says LOST. */
async function silence(rig, page, seen) {
  await eventually("a live link", async () =>
    /GOOD|DEGRADED/.test(await page.textContent(".link-tile .word")),
  );
  await pause(1000 + 100 * Math.random());
  const asked = now();
  rig.programs.car.kill("SIGSTOP");
  await pause(1500);
  const shown = (await seen("links")).find(({ text, at }) => /LOST/.test(text) && at > asked);
  const lost = (shown?.at ?? Infinity) - rig.newest.at;
  rig.programs.car.kill("SIGCONT");
  await pause(1000);
  return lost;
}

/** Blocks, see blocks.mjs. `drawn`: ms of each number in windows, `lost`: ms of each silence. */
export async function pixelFigures(rig) {
  const browser = await launch();
  try {
    const { page } = await open(browser, rig.address, { size: [1920, 1080] });
    await pause(kSettleMs);
    await page.evaluate(watch, ["drawn", `[data-path="${kNumberPath}"] .digits`]);
    await page.evaluate(watch, ["links", ".link-tile .word"]);
    const offset = await clockOffset(page);
    const seen = async (name) =>
      (await page.evaluate((of) => globalThis[of], name)).map(({ text, at }) => ({
        text,
        number: Number(text),
        at: at + offset,
      }));
    await pause(100);
    const first = rig.left.length;
    const blocks = await windows(kWindows);
    await pause(500);
    const drawn = withDelays(blocks, rig.left.slice(first), [await seen("drawn")]);
    return { drawn, lost: await happenings(kSilences, () => silence(rig, page, seen)) };
  } finally {
    await browser.close();
  }
}
