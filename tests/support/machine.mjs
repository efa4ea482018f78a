/**
 * What the machine did to a test that lives in real time: its host may take a virtual machine's
 * processors away for tens of milliseconds.
 */
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";

const kMsPerTick = 10;
const kStealColumn = 8;
const kLookMs = 5;

/** Processor time that the host kept from this machine since its start: `steal`, see proc(5). */
export function takenMs() {
  const ticks = readFileSync("/proc/stat", "utf8").split("\n")[0].split(/ +/);
  return Number(ticks[kStealColumn]) * kMsPerTick;
}

/** Watches until the process ends. This one, too, waits for a processor: an upper bound. */
export class Machine {
  #taken = takenMs();
  #latestMs = 0;

  constructor() {
    let due = performance.now() + kLookMs;
    const timer = setInterval(() => {
      const now = performance.now();
      this.#latestMs = Math.max(this.#latestMs, now - due);
      due = now + kLookMs;
    }, kLookMs);
    timer.unref();
  }

  get told() {
    return (
      `machine: its host took ${takenMs() - this.#taken} ms of processor time; ` +
      `this test itself came up to ${this.#latestMs.toFixed(0)} ms late`
    );
  }
}
