/**
 * How the console looks, measured on what is drawn: nothing scrolls or overlaps on the primary
 * page, targets are large enough for gloves; on every page in every theme axe finds nothing
 * serious, text has its contrast, good, warning and bad stay apart for every kind of colour vision,
 * and nothing is written to the browser's console or asked for elsewhere. The pictures of what was
 * measured lie in build/console/screenshots.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { cvdDistance, contrast, parseColour } from "./colour.mjs";
import { kAxe } from "./packages.mjs";
import { doubleStage, kDeskSizes, kPages, kScreenshots, kSizes, kThemes } from "./stage.mjs";
import { show, until } from "./stage.mjs";
import { checklist, contactRun, greetings, kRecordings, stopped, troubles } from "./story.mjs";

const kLabelPx = 14;
const kTouchPx = 44;
const kCommandPx = 64;
const kTextContrast = 7;
const kStatusContrast = 4.5;
const kLeastDistance = 20;

const stage = doubleStage((double) => {
  double.framesPerSecond = 5; // what is drawn is looked at, not how often
  double.greetings = greetings(double);
  Object.assign(double, { checklist, recordings: kRecordings });
  troubles(double);
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

/** Every text in sight that is drawn smaller, with its size. */
const smallTexts = (least) => {
  const found = new Set();
  for (const e of document.querySelectorAll("body *")) {
    const own = [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim() !== "");
    const typed = e.matches("input, select, textarea");
    if ((!own && !typed) || e.getClientRects().length === 0) continue;
    if (e.closest(".sr-only, option, script, style")) continue;
    const px = parseFloat(getComputedStyle(e).fontSize);
    const before = getComputedStyle(e, "::before");
    const text = (e.textContent || e.ariaLabel || "").slice(0, 30);
    if (px < least - 0.01) found.add(`${px} px: ${e.className || e.tagName} "${text}"`);
    if (!["none", "normal", '""'].includes(before.content) && parseFloat(before.fontSize) < least)
      found.add(`${before.fontSize} before ${e.className}`);
  }
  return [...found];
};

/** Notes the size of every text that is drawn on a canvas from now on, in pixels of the page. */
const watchCanvas = () => {
  const drawn = (globalThis.drawnPx = []);
  const known = new Set();
  const { fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
    const key = `${this.font} ${text}`;
    if (!known.has(key) && known.add(key)) {
      drawn.push([Number(/([\d.]+)px/.exec(this.font)[1]) / devicePixelRatio, text]);
    }
    return fillText.call(this, text, ...rest);
  };
};

for (const size of kSizes) {
  test(`primary fits ${size.join(" x ")}: no scroll bar, nothing cut or over another`, async () => {
    const { page } = await stage.open({ size });
    await page.waitForTimeout(800);
    await page.screenshot({ path: join(kScreenshots, `primary_${size.join("x")}.png`) });
    assert.deepEqual(await page.evaluate(cutOff), []);
  });
}

for (const size of kDeskSizes) {
  const named = size.join(" x ");
  test(`primary fits beside the card of a stop at ${named}`, async () => {
    stage.double.greetings.push(stopped(stage.double.nowMs()));
    const { page } = await stage.open({ size });
    await until(page, "the card", () => document.querySelector(".stop-card"));
    await page.waitForTimeout(800);
    await page.screenshot({ path: join(kScreenshots, `primary_stopped_${size.join("x")}.png`) });
    assert.deepEqual(await page.evaluate(cutOff), []);
  });

  test(`no text is smaller than ${kLabelPx} px on any page at ${named}`, async () => {
    stage.double.greetings.push(stopped(stage.double.nowMs()));
    const { page } = await stage.open({ size });
    await page.evaluate(watchCanvas);
    for (const name of [...kPages, "primary"]) {
      await show(page, name);
      await page.waitForTimeout(600);
      assert.deepEqual(await page.evaluate(smallTexts, kLabelPx), [], name);
    }
    for (const key of ["?", "/"]) {
      await page.keyboard.press(key);
      await page.waitForTimeout(300);
      assert.deepEqual(await page.evaluate(smallTexts, kLabelPx), [], `key ${key}`);
      await page.keyboard.press("Escape");
    }
    const drawn = await page.evaluate(() => globalThis.drawnPx);
    assert.ok(drawn.length > 3, "texts were drawn on canvases");
    assert.deepEqual(
      drawn.filter(([px]) => px < kLabelPx),
      [],
      "on a canvas",
    );
  });
}

test("targets are large enough on every page", async () => {
  const { page } = await stage.open({ size: [1024, 768] });
  for (const name of kPages) {
    await show(page, name);
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
});

/** What axe finds serious or critical. */
const graveFaults = async () => {
  const { violations } = await globalThis.axe.run(document, { resultTypes: ["violations"] });
  const where = (v) => v.nodes.slice(0, 3).map((n) => n.html.slice(0, 120));
  return violations
    .filter((v) => ["serious", "critical"].includes(v.impact))
    .map((v) => `${v.id}: ${where(v).join(" | ")}`);
};

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
    if (!own || e.getClientRects().length === 0 || e.closest(".sr-only, [disabled], option"))
      continue;
    const style = getComputedStyle(e);
    if (style.visibility === "hidden") continue;
    const ground = behind(e);
    if (ground === null) continue;
    const status =
      e.closest(
        '[data-judgement="warning"], [data-judgement="bad"], .count, ' +
          '.car-tab[data-alarmed="true"], ' +
          ".alarm-line, .alarm .state, .gate, .fallen, .stop, .mode-word, .flood, .behind, " +
          '.verdict, [data-standing="failed"], ' +
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

/** Texts whose letters stand out too little from what is behind them. */
function weakTexts(drawn) {
  return drawn
    .map((t) => ({ ...t, ratio: contrast(parseColour(t.ink), parseColour(t.ground)) }))
    .filter((t) => t.ratio < (t.status ? kStatusContrast : kTextContrast))
    .map((t) => `${t.ratio.toFixed(2)} ${t.where} "${t.example}" ${t.ink} on ${t.ground}`);
}

/** Good, warning and bad as they are filled, with how far two of them are apart at the least. */
async function fillDistances(page) {
  const drawn = await page.evaluate(() => {
    const fill = (selector) => getComputedStyle(document.querySelector(selector)).backgroundColor;
    return {
      good: fill('.watchdogs .value[data-judgement="good"] .mark'),
      warning: fill('.watchdogs .value[data-judgement="warning"]'),
      bad: fill('.watchdogs .value[data-judgement="bad"]'),
    };
  });
  const pairs = [
    ["good", "warning"],
    ["good", "bad"],
    ["warning", "bad"],
  ];
  return pairs.map(([a, b]) => ({
    pair: `${a} ${drawn[a]} and ${b} ${drawn[b]}`,
    least: cvdDistance(parseColour(drawn[a]), parseColour(drawn[b])),
  }));
}

for (const theme of kThemes) {
  test(`the ${theme} theme on every page: axe, contrast, colours apart, no fault`, async () => {
    const { page, faults } = await stage.open({ theme });
    await page.waitForTimeout(1500);
    for (const { pair, least } of await fillDistances(page)) {
      assert.ok(least >= kLeastDistance, `${pair} are ${least.toFixed(1)} apart`);
    }
    await page.evaluate(kAxe);
    for (const name of kPages) {
      await show(page, name);
      await page.waitForTimeout(500);
      await page.screenshot({ path: join(kScreenshots, `${name}_${theme}.png`) });
      const drawn = await page.evaluate(texts);
      assert.ok(drawn.length > 3, "there is text");
      assert.deepEqual(weakTexts(drawn), [], `${name}: contrast`);
      assert.deepEqual(await page.evaluate(graveFaults), [], `${name}: axe`);
    }
    assert.deepEqual(faults, []);
  });
}

test("a contact with another car: by whom, by which rule, where, in every theme", async () => {
  stage.double.greetings.push(...contactRun());
  for (const theme of kThemes) {
    const { page, faults, context } = await stage.open({ theme });
    await page.evaluate(kAxe);
    await show(page, "hil");
    await until(page, "the contact", () => document.querySelector(".contact"));
    assert.equal(await page.textContent(".contact .sum b"), "THIS CAR");
    const panel = await page.textContent(".contact");
    const rule = "rule 2: the car behind must pass safely";
    for (const part of [rule, "slow (2)", "1204 m", "53.62 s"])
      assert.ok(panel.includes(part), `${part} in ${panel}`);
    assert.match(await page.textContent(".event-list"), /caused by this car/);
    await page.screenshot({ path: join(kScreenshots, `hil_contact_${theme}.png`) });
    assert.deepEqual(weakTexts(await page.evaluate(texts)), [], `${theme}: contrast`);
    assert.deepEqual(await page.evaluate(smallTexts, kLabelPx), [], theme);
    assert.deepEqual(await page.evaluate(graveFaults), [], `${theme}: axe`);
    assert.deepEqual(faults, []);
    await context.close();
  }
});

for (const theme of kThemes) {
  test(`two cars of one base: both on the map, a stop for all, in the ${theme} theme`, async () => {
    stage.double.cars = [
      { number: 7, name: "Caracara" },
      { number: 8, name: "Shrike" },
    ];
    const { page, faults } = await stage.open({ theme });
    await until(page, "the other car", () => globalThis.pitwall.session.cars.value[1]?.track.value);
    await page.evaluate(kAxe);
    await page.evaluate(watchCanvas);
    await page.waitForTimeout(1500);
    await page.screenshot({ path: join(kScreenshots, `primary_two_${theme}.png`) });
    const drawn = (await page.evaluate(() => globalThis.drawnPx)).map(([, text]) => text);
    for (const text of ["7", "8", "car 8", "#12", "#45"]) assert.ok(drawn.includes(text), text);
    assert.deepEqual(await page.evaluate(cutOff), []);
    assert.deepEqual(weakTexts(await page.evaluate(texts)), [], "contrast");
    assert.deepEqual(await page.evaluate(smallTexts, kLabelPx), []);
    assert.deepEqual(await page.evaluate(graveFaults), [], "axe");
    const box = await page.locator(".stop.all").boundingBox();
    assert.ok(box.height >= kCommandPx && box.width >= kTouchPx, `${box.width} x ${box.height}`);
    await page.click(".stop.all");
    await page.keyboard.press("Control+Shift+X");
    const stops = () => stage.double.received.filter(({ type }) => type === "stop");
    for (let n = 0; n < 50 && stops().length < 4; ++n) await page.waitForTimeout(20);
    assert.deepEqual(stops(), Array(4).fill({ type: "stop", kind: "controlled" }));
    assert.deepEqual(faults, []);
  });
}

test("a stale value is grey and struck, and has a shape besides its colour", async () => {
  const { page } = await stage.open();
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
});

test("the primary page in each world, held in the past, and with a silent car", async () => {
  const shoot = (page, name) => page.screenshot({ path: join(kScreenshots, `world_${name}.png`) });
  const size = [1280, 800];
  for (const mode of ["REAL", "REPLAY", "NONE"]) {
    stage.double.hello.mode = mode;
    const { page, context } = await stage.open({ size });
    await page.waitForTimeout(1200);
    await shoot(page, mode.toLowerCase());
    await context.close();
  }
  stage.double.hello.mode = "HIL";
  const { page, context } = await stage.open({ size });
  await page.waitForTimeout(2500);
  await page.keyboard.press("ArrowLeft");
  await page.waitForTimeout(500);
  await shoot(page, "held");
  await page.keyboard.press("l");
  await page.keyboard.press("?");
  await page.waitForTimeout(300);
  await shoot(page, "keys");
  await page.keyboard.press("?");
  stage.double.silence();
  await page.waitForTimeout(4000);
  await shoot(page, "silent");
  assert.deepEqual(await page.evaluate(cutOff), [], "of a silent car");
  await context.close();
});
