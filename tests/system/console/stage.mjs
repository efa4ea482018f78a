/**
 * A browser for the tests: real headless Chromium, one page on a base, with every console error and
 * every request elsewhere kept.
 */
// SPDX-License-Identifier: Apache-2.0
import { existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { chromium, kRoot } from "./packages.mjs";

const kChromium = process.env.PITWALL_CHROMIUM || "/usr/bin/chromium";
export const kScreenshots = join(kRoot, "build/console/screenshots");
export const kPages = ["primary", "plots", "telemetry", "link", "commands", "alarms"];
export const kThemes = ["dark", "light", "sun"];
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

/** A page on `address`, live: resolves when the first values are drawn. */
export async function open(browser, address, options = {}) {
  const { size = [1920, 1080], theme = "dark", hash = "", ownClock = false } = options;
  const context = await browser.newContext({
    viewport: { width: size[0], height: size[1] },
  });
  const page = await context.newPage();
  if (ownClock) await page.clock.install();
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
  await page.waitForFunction(() => document.querySelector('.value[data-quality="fresh"]'));
  return { page, faults, context };
}

/** Resolves when `test` holds in the page; fails loudly with what it was waiting for. */
export async function until(page, what, test, argument, timeoutMs = 5000) {
  try {
    await page.waitForFunction(test, argument, {
      timeout: timeoutMs,
      polling: 20,
    });
  } catch {
    throw new Error(`waited ${timeoutMs} ms in vain for: ${what}`);
  }
}
