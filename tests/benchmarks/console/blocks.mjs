/**
 * Figures of real time on a machine that is not ours alone. Whatever else runs there, and the host
 * of a virtual machine, only ever makes such a figure worse: it is taken in five blocks, and the
 * best block counts. Beside it stand all parts of the blocks that were left alone, and all that
 * were disturbed: by the host (Linux counts what it took, `steal` in /proc/stat, see proc(5)), or
 * by programs that are none of ours.
 */
// SPDX-License-Identifier: Apache-2.0
import { othersMs, takenMs } from "../../support/machine.mjs";
import { delays, InVain, now, pause, quantile } from "./rig.mjs";

export const kBlocks = 5;
const kWindowMs = 3000;
/** More taken by the host, and a window was disturbed; a single happening: a tick of the count. */
const kTakenOfWindowMs = 20;
const kTakenOfOneMs = 10;
/** More of a processor that other programs had than this, and either was. */
const kOthersShare = 0.1;

const isThere = (figure) => figure !== undefined && !Number.isNaN(figure);
const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);

/**
 * A figure of `blocks`, which are lists of parts: `{disturbed, ...}`. `figureOf(parts)`: NaN or
 * undefined where the parts give none. `best`: of all blocks, undefined where none gave a figure.
 */
export function summary(blocks, figureOf, better = Math.min) {
  const figures = blocks.map((parts) => figureOf(parts)).filter(isThere);
  const column = (wanted) => {
    const parts = blocks.flat().filter(({ disturbed }) => disturbed === wanted);
    const figure = parts.length > 0 ? figureOf(parts) : undefined;
    return { parts: parts.length, figure: isThere(figure) ? figure : undefined };
  };
  return {
    best: figures.length > 0 ? better(...figures) : undefined,
    undisturbed: column(false),
    disturbed: column(true),
  };
}

/** Of the values of parts. */
export const quantileOf = (share) => (parts) =>
  quantile(
    parts.flatMap(({ values }) => values),
    share,
  );
export const worst = quantileOf(1);
/** What was counted of this for each ms; NaN of no parts. */
export const rateOf = (name) => (parts) =>
  sum(parts.map((part) => part[name])) / sum(parts.map(({ from, to }) => to - from));

/** What others have had until now. */
const counts = () => ({ takenMs: takenMs(), othersMs: othersMs(), at: now() });

/** Whether others had more than their share between two such counts. */
export function isDisturbed(before, after, mostTakenMs) {
  const others = after.othersMs - before.othersMs;
  return (
    after.takenMs - before.takenMs > mostTakenMs || others > kOthersShare * (after.at - before.at)
  );
}

/**
 * Blocks of `count` happenings: `happen()` resolves with a value. Where one is waited for in vain
 * its value is endless, and the block is over.
 */
export async function happenings(count, happen, look = counts) {
  const blocks = Array.from({ length: kBlocks }, () => []);
  for (const parts of blocks) {
    while (parts.length < count && parts.at(-1)?.values[0] !== Infinity) {
      const before = look();
      const values = [await happen().catch(endless)].flat();
      parts.push({ values, disturbed: isDisturbed(before, look(), kTakenOfOneMs) });
    }
  }
  return blocks;
}

function endless(error) {
  if (error instanceof InVain) return Infinity;
  throw error;
}

/** Blocks of `count` windows. `probe()`: counts that go up, by name; the part has their growth. */
export async function windows(count, probe = () => ({}), blocks = kBlocks) {
  const all = Array.from({ length: blocks }, () => []);
  for (const parts of all) {
    while (parts.length < count) parts.push(await window(probe));
  }
  return all;
}

async function window(probe) {
  const before = counts();
  const probed = probe();
  const from = now();
  await pause(kWindowMs);
  const to = now();
  const growth = Object.entries(probe()).map(([name, count]) => [name, count - probed[name]]);
  const disturbed = isDisturbed(before, counts(), kTakenOfWindowMs);
  return { from, to, ...Object.fromEntries(growth), disturbed };
}

/** The same blocks with `values`: delays of what left within a window until each viewer saw it. */
export function withDelays(blocks, left, sights) {
  const late = sights.map((seen) => delays(left, seen));
  return blocks.map((parts) =>
    parts.map((part) => ({
      ...part,
      values: late.flatMap((all) =>
        all.filter((_, i) => left[i].at >= part.from && left[i].at < part.to),
      ),
    })),
  );
}
