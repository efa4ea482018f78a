/**
 * Time in which the machine was ours. The host of a virtual machine takes its processors away for
 * tens of milliseconds, and what had to wait then says nothing about the program that waited. Linux
 * counts what was taken: `steal` in /proc/stat, see proc(5); on a machine of one's own it is 0.
 */
// SPDX-License-Identifier: Apache-2.0
import { takenMs } from "../../support/machine.mjs";
import { delays, now, pause } from "./rig.mjs";

const kWindowMs = 3000;
/** More of a window than this, and it does not count. */
const kTakenMs = 20;
/** What is watched for each that is wanted, before we give up; and at least. */
const kPatience = 8;
const kLeastPatience = 40;

/** The same for a single happening, which is shorter: one tick of the kernel's count. */
const kTakenFromOneMs = 10;

const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);

/**
 * What `happen()` gave in `wanted` times that the host left alone, and how many it did not.
 * `what`: names them where there are too few.
 */
export async function leftAlone(what, wanted, happen) {
  const results = [];
  let disturbed = 0;
  while (results.length < wanted) {
    if (results.length + disturbed >= Math.max(kPatience * wanted, kLeastPatience)) {
      const tried = results.length + disturbed;
      throw new Error(`the host left ${results.length} of ${tried} alone, ${what}: no figures`);
    }
    const taken = takenMs();
    const result = await happen();
    if (takenMs() - taken > kTakenFromOneMs) disturbed += 1;
    else results.push(result);
  }
  return { results, disturbed };
}

/** Of `wanted` windows without disturbance. `probe()`: a count in ms that goes up. */
export class Quiet {
  windows = [];
  disturbed = 0;

  static async watch(wanted, probe) {
    const quiet = new Quiet();
    while (quiet.windows.length < wanted) {
      if (quiet.windows.length + quiet.disturbed >= kPatience * wanted) {
        throw new Error(
          `the host left the machine alone in ${quiet.windows.length} of ` +
            `${quiet.windows.length + quiet.disturbed} windows of ${kWindowMs} ms: no figures`,
        );
      }
      await quiet.#window(probe);
    }
    return quiet;
  }

  async #window(probe) {
    const taken = takenMs();
    const counted = probe();
    const from = now();
    await pause(kWindowMs);
    const to = now();
    if (takenMs() - taken > kTakenMs) this.disturbed += 1;
    else this.windows.push({ from, to, counted: probe() - counted });
  }

  /** Of what was counted, for each ms. */
  get share() {
    return sum(this.windows.map((w) => w.counted)) / sum(this.windows.map((w) => w.to - w.from));
  }

  /** Those delays of `left` that lie in the windows. */
  delays(left, seen) {
    return delays(left, seen).filter((_, i) =>
      this.windows.some(({ from, to }) => left[i].at >= from && left[i].at < to),
    );
  }
}
