/**
 * The clock of the programs that a test starts: bench time where real_time/in_bench_time keeps one,
 * else the wall's. A test that compares its own times with theirs takes them here.
 */
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { setTimeout as nap } from "node:timers/promises";

const kFile = process.env.PITWALL_TEST_CLOCK;
/** In the page: protocol/transport/bench_clock/clock_page.hpp. */
const kLostAt = 8;

/** Of a program that goes by it. */
export const kClockFlags = kFile ? ["--clock", kFile] : [];

/** Milliseconds since 1970, less those for which bench time stood. */
export function nowMs() {
  const lostNs = kFile ? readFileSync(kFile).readBigInt64LE(kLostAt) : 0n;
  return Date.now() - Number(lostNs) / 1e6;
}

/** Resolves when so much has passed by that clock. */
export async function pass(ms) {
  for (const end = nowMs() + ms; nowMs() < end;) await nap(Math.max(1, end - nowMs()));
}
