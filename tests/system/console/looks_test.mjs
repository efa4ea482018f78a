/**
 * How the console looks, measured on what is drawn: nothing scrolls or overlaps on the primary
 * page, targets are large enough for gloves, axe finds nothing serious, text has its contrast, and
 * good, warning and bad stay apart for every kind of colour vision.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Double } from "./double.mjs";
import { cvdDistance, contrast, parseColour } from "./colour.mjs";
import { kAxe } from "./packages.mjs";
import { kPages, kSizes, kThemes, launch, open } from "./stage.mjs";
import { greetings, troubles } from "./story.mjs";

const kTouchPx = 44;
const kCommandPx = 64;
const kTextContrast = 7;
const kStatusContrast = 4.5;
const kLeastDistance = 20;

let browser;
let double;
let address;

before(async () => {
  browser = await launch();
  double = new Double();
  double.greetings = greetings(double);
  troubles(double);
  address = await double.listen();
});
after(async () => {
  await browser?.close();
  await double?.close();
});

/** Elements of the page whose content is cut off or that reach out of their panel. */
const cutOff = () => {
  const found = [];
  const seen = (e) => e.getClientRects().length > 0;
  for (const e of document.querySelectorAll(".primary, .primary .panel, .primary .column, body")) {
    if (e.scrollHeight > e.clientHeight + 1 || e.scrollWidth > e.clientWidth + 1) {
      found.push(
        `${e.className || e.tagName} ${e.scrollWidth}x${e.scrollHeight} in ` +
          `${e.clientWidth}x${e.clientHeight}`,
      );
    }
  }
  for (const e of document.querySelectorAll(".primary .digits, .top-bar .digits, .top-bar .word")) {
    if (seen(e) && e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).display !== "inline") {
      found.push(`digits cut: ${e.textContent} (${e.parentElement.dataset.path ?? "frame"})`);
    }
  }
  const panels = [...document.querySelectorAll(".primary .panel")].map((e) => [
    e.className,
    e.getBoundingClientRect(),
  ]);
  panels.forEach(([a, p], i) =>
    panels.slice(i + 1).forEach(([b, q]) => {
      if (
        p.left < q.right - 1 &&
        q.left < p.right - 1 &&
        p.top < q.bottom - 1 &&
        q.top < p.bottom - 1
      ) {
        found.push(`${a} over ${b}`);
      }
    }),
  );
  for (const e of document.querySelectorAll(".primary .value, .primary .label")) {
    const panel = e.closest(".panel").getBoundingClientRect();
    const box = e.getBoundingClientRect();
    if (seen(e) && (box.bottom > panel.bottom + 1 || box.right > panel.right + 1)) {
      found.push(`out of its panel: ${e.textContent}`);
    }
  }
  return found;
};

for (const size of kSizes) {
  test(`primary fits ${size.join(" x ")}: no scroll bar, nothing cut or over another`, async () => {
    const { page, context } = await open(browser, address, { size });
    await page.waitForTimeout(800);
    assert.deepEqual(await page.evaluate(cutOff), []);
    await context.close();
  });
}

test("targets are large enough on every page", async () => {
  const { page, context } = await open(browser, address, { size: [1024, 768] });
  for (const name of kPages) {
    await page.evaluate((hash) => (location.hash = hash), `#/${name}`);
    await page.waitForTimeout(300);
    const small = await page.evaluate(
      ([touch, command]) =>
        [...document.querySelectorAll("button, select, input:not([type=range])")]
          .filter((e) => e.getClientRects().length > 0)
          .map((e) => [
            e,
            e.getBoundingClientRect(),
            e.matches(".stop, .send, .stage *") ? command : touch,
          ])
          .filter(
            ([e, box, least]) =>
              box.height < (e.closest(".alarm-line, .chart") ? 32 : least) - 0.5 ||
              box.width < touch - 0.5,
          )
          .map(([e, box]) => `${e.textContent || e.ariaLabel} ${box.width}x${box.height}`),
      [kTouchPx, kCommandPx],
    );
    assert.deepEqual(small, [], name);
  }
  await context.close();
});

test("axe finds nothing serious on any page in any theme", async () => {
  for (const theme of kThemes) {
    const { page, context } = await open(browser, address, { theme });
    await page.evaluate(kAxe);
    for (const name of kPages) {
      await page.evaluate((hash) => (location.hash = hash), `#/${name}`);
      await page.waitForTimeout(400);
      const grave = await page.evaluate(async () => {
        const { violations } = await globalThis.axe.run(document, {
          resultTypes: ["violations"],
        });
        return violations
          .filter((v) => ["serious", "critical"].includes(v.impact))
          .map(
            (v) =>
              `${v.id}: ${v.nodes
                .slice(0, 3)
                .map((n) => n.html.slice(0, 120))
                .join(" | ")}`,
          );
      });
      assert.deepEqual(grave, [], `${name} in ${theme}`);
    }
    await context.close();
  }
});

/** Every drawn text with the colour of its letters and of what lies behind them. */
const texts = () => {
  const behind = (e) => {
    for (let at = e; at; at = at.parentElement) {
      const { backgroundColor, backgroundImage } = getComputedStyle(at);
      if (backgroundImage !== "none") return null;
      if (!/^rgba.*, 0\)$|transparent/.test(backgroundColor)) return backgroundColor;
    }
    return "rgb(255, 255, 255)";
  };
  const found = new Map();
  for (const e of document.querySelectorAll("#console *")) {
    const own = [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim() !== "");
    if (!own || e.getClientRects().length === 0 || e.closest(".heard-only, [disabled], option"))
      continue;
    const style = getComputedStyle(e);
    if (style.visibility === "hidden") continue;
    const ground = behind(e);
    if (ground === null) continue;
    const status =
      e.closest(
        '[data-judgement="warning"], [data-judgement="bad"], .count, ' +
          ".alarm-line, .alarm .state, .gate, .fallen, .stop, .mode-word, .flood, .behind, " +
          '[data-quality="stale"], [data-quality="never"]',
      ) !== null;
    const key = `${style.color} on ${ground} ${status}`;
    if (!found.has(key)) {
      found.set(key, {
        ink: style.color,
        ground,
        status,
        example: e.textContent.slice(0, 30),
        where: e.className || e.tagName,
      });
    }
  }
  return [...found.values()];
};

test("text has its contrast: 7 to 1, status words 4.5 to 1", async () => {
  for (const theme of kThemes) {
    const { page, context } = await open(browser, address, { theme });
    for (const name of kPages) {
      await page.evaluate((hash) => (location.hash = hash), `#/${name}`);
      await page.waitForTimeout(400);
      const drawn = await page.evaluate(texts);
      assert.ok(drawn.length > 3, "there is text");
      const weak = drawn
        .map((t) => ({
          ...t,
          ratio: contrast(parseColour(t.ink), parseColour(t.ground)),
        }))
        .filter((t) => t.ratio < (t.status ? kStatusContrast : kTextContrast))
        .map((t) => `${t.ratio.toFixed(2)} ${t.where} "${t.example}" ${t.ink} on ${t.ground}`);
      assert.deepEqual(weak, [], `${name} in ${theme}`);
    }
    await context.close();
  }
});

test("good, warning and bad as drawn stay apart for every colour vision", async () => {
  for (const theme of kThemes) {
    const { page, context } = await open(browser, address, { theme });
    await page.waitForTimeout(500);
    const drawn = await page.evaluate(() => {
      const fill = (selector) => getComputedStyle(document.querySelector(selector)).backgroundColor;
      return {
        good: fill('.watchdogs .value[data-judgement="good"] .mark'),
        warning: fill('.watchdogs .value[data-judgement="warning"]'),
        bad: fill('.watchdogs .value[data-judgement="bad"]'),
      };
    });
    const names = Object.keys(drawn);
    for (const a of names) {
      for (const b of names.slice(names.indexOf(a) + 1)) {
        const least = cvdDistance(parseColour(drawn[a]), parseColour(drawn[b]));
        assert.ok(
          least >= kLeastDistance,
          `${theme}: ${a} ${drawn[a]} and ${b} ${drawn[b]} are ${least.toFixed(1)} apart`,
        );
      }
    }
    await context.close();
  }
});

test("a stale value is grey and struck, and has a shape besides its colour", async () => {
  const { page, context } = await open(browser, address);
  await page.waitForTimeout(500);
  const drawn = await page.evaluate(() => {
    const value = document.querySelector('.value[data-quality="stale"]');
    const style = (selector) => getComputedStyle(value.querySelector(selector));
    return {
      line: style(".digits").textDecorationLine,
      mark: style(".mark").display,
      shape: style(".mark").clipPath,
      ink: style(".digits").color,
    };
  });
  assert.equal(drawn.line, "line-through");
  assert.equal(drawn.mark, "block");
  assert.match(drawn.shape, /polygon/);
  const [r, g, b] = parseColour(drawn.ink);
  assert.ok(Math.max(r, g, b) - Math.min(r, g, b) < 30, `${drawn.ink} is grey`);
  await context.close();
});
