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
/** Windows that are watched for each that is wanted, before we give up. */
const kPatience = 8;

const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);

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
