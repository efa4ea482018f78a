/**
 * The stage of the tests: one real headless Chromium for a file of them, pages on a base with every
 * console error and every request elsewhere kept, and before each test a base: the double, or the
 * real one with a car's end of the radio. What a test opened is closed behind it.
 */
// SPDX-License-Identifier: Apache-2.0
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { after, afterEach, before, beforeEach } from "node:test";
import { join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { eventually, kPatienceMs } from "./client.mjs";
import { Double } from "./double.mjs";
import { chromium, kRoot } from "./packages.mjs";
import { Programs } from "./programs.mjs";

const kChromium = "/usr/bin/chromium-headless-shell";
/** A browser that does not end is killed with the test's process. */
const kCloseMs = 10_000;
export const kScreenshots = join(kRoot, "build/console/screenshots");
export const kPages = [
  "primary",
  "plots",
  "telemetry",
  "link",
  "commands",
  "alarms",
  "race",
  "hil",
  "replay",
  "events",
];
export const kThemes = ["dark", "light", "sun"];
/** Of a pit wall's desk and of a laptop on it. */
export const kDeskSizes = [
  [1280, 800],
  [1920, 1080],
];
export const kSizes = [
  [1920, 1080],
  [1280, 800],
  [1024, 768],
];

export async function launch() {
  if (!existsSync(kChromium)) throw new Error(`no Chromium at ${kChromium} (./pitwall setup)`);
  mkdirSync(kScreenshots, { recursive: true });
  return chromium.launch({
    executablePath: kChromium,
    args: process.getuid() === 0 ? ["--no-sandbox"] : [],
  });
}

/** All processes that this one has started, and theirs. */
function descendants(pid) {
  const children = readFileSync(`/proc/${pid}/task/${pid}/children`, "utf8").split(" ");
  return children
    .filter(Boolean)
    .flatMap((child) => [Number(child), ...descendants(Number(child))]);
}

/** A browser of its own, every process of which can be stopped as a whole and go on. */
export async function launchApart() {
  const server = await chromium.launchServer({
    executablePath: kChromium,
    args: process.getuid() === 0 ? ["--no-sandbox"] : [],
  });
  const { pid } = server.process();
  const signal = (name) => {
    for (const each of [pid, ...descendants(pid)]) process.kill(each, name);
  };
  return {
    browser: await chromium.connect(server.wsEndpoint()),
    stop: () => signal("SIGSTOP"),
    go: () => signal("SIGCONT"),
    close: () => server.kill(),
  };
}

/**
 * A page on `address`, live: resolves when the first values are drawn (or when there is what
 * `ready` selects). A `script` runs before those of the page.
 */
export async function open(browser, address, options = {}) {
  const {
    size = [1280, 800],
    theme = "dark",
    hash = "",
    ownClock = false,
    ready,
    script,
  } = options;
  const context = await browser.newContext({
    viewport: { width: size[0], height: size[1] },
  });
  const page = await context.newPage();
  page.setDefaultTimeout(kPatienceMs);
  if (ownClock) await page.clock.install();
  if (script) await page.addInitScript(script);
  const faults = [];
  page.on("console", (message) => {
    if (message.type() === "error" || message.type() === "warning") faults.push(message.text());
  });
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("request", (request) => {
    if (!request.url().startsWith(address) && !request.url().startsWith("blob:")) {
      faults.push(`request elsewhere: ${request.url()}`);
    }
  });
  await page.addInitScript((name) => {
    if (!sessionStorage.getItem("themed")) localStorage.setItem("pitwall.theme", name);
    sessionStorage.setItem("themed", "1");
  }, theme);
  await page.goto(`${address}/${hash}`);
  await page.waitForSelector(ready ?? '.value[data-quality="fresh"]', { state: "attached" });
  return { page, faults, context };
}

/** Resolves with what `test` says in the page once it is something; or says what was waited for. */
export async function until(page, what, test, argument) {
  try {
    const said = await page.waitForFunction(test, argument, {
      timeout: kPatienceMs,
      polling: 20,
    });
    return await said.jsonValue();
  } catch {
    throw new Error(`waited ${kPatienceMs} ms in vain for: ${what}`);
  }
}

/** Goes to a page of the console that is open already. */
export const show = (page, name) => page.evaluate((hash) => (location.hash = hash), `#/${name}`);

/** Tabs on until the focus is on an element; fails where Tab never comes there. */
export async function reach(page, selector) {
  for (let n = 0; n < 120; ++n) {
    if (await page.evaluate((s) => document.activeElement?.matches(s), selector)) return;
    await page.keyboard.press("Tab");
  }
  throw new Error(`Tab does not reach ${selector}`);
}

/** Escape twice, sent together: however slow the machine, one person's two quick presses. */
export async function escapeTwice(page) {
  const devtools = await page.context().newCDPSession(page);
  const key = { key: "Escape", code: "Escape", windowsVirtualKeyCode: 27 };
  const press = (type) => devtools.send("Input.dispatchKeyEvent", { type, ...key });
  await Promise.all(["keyDown", "keyUp", "keyDown", "keyUp"].map(press));
  await devtools.detach();
}

/** Presses the mouse on an element for so long. */
export async function hold(page, selector, ms) {
  const element = page.locator(selector).first();
  await element.scrollIntoViewIfNeeded();
  await element.hover();
  await page.mouse.down();
  await page.waitForTimeout(ms);
  await page.mouse.up();
}

/** One browser for all tests of a file; `open` opens the console of the test's base in it. */
function browserStage() {
  const stage = {
    browser: undefined,
    address: undefined,
    open: (options) => open(stage.browser, stage.address, options),
  };
  before(async () => (stage.browser = await launch()));
  after(() => Promise.race([stage.browser?.close(), sleep(kCloseMs, undefined, { ref: false })]));
  return stage;
}

async function closePages(stage) {
  await Promise.all(stage.browser.contexts().map((context) => context.close()));
}

/** Resolves when all that a page has sent so far has reached the double, however slow both are. */
async function arrived(page, double) {
  const mark = double.mark + 1;
  await page.evaluate(
    (n) => globalThis.pitwall.session.shownCar.value.send({ type: "mark of the test", n }),
    mark,
  );
  await eventually("the page's mark at the base", () => double.mark >= mark);
}

/** A double for each test, `prepare`d before anybody connects. */
export function doubleStage(prepare = () => {}) {
  const stage = browserStage();
  stage.arrived = (page) => arrived(page, stage.double);
  beforeEach(async () => {
    stage.double = new Double();
    prepare(stage.double);
    stage.address = await stage.double.listen();
  });
  afterEach(async () => {
    await closePages(stage);
    await stage.double.close();
  });
  return stage;
}

/** The real base for each test, with a car's end of the radio unless it is told not to. */
export function baseStage({ car = true, flags = () => [] } = {}) {
  const stage = browserStage();
  beforeEach(async () => {
    stage.programs = new Programs();
    stage.address = await stage.programs.startBase(...flags(stage.programs));
    if (car) stage.programs.startCar();
  });
  afterEach(async () => {
    await closePages(stage);
    await stage.programs.close();
  });
  return stage;
}
