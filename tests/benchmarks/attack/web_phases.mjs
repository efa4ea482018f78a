/**
 * What is done to the base's consoles, each beside a quiet twin.
 *
 * crowd      who comes, see crowd.mjs; viewers have a token
 * limit      what the base may use meanwhile, see limits.mjs
 * fresh      the base is started anew before it: no memory of an earlier crowd
 * later_ms   how much later than the twin's a stop may be, p99
 * says       what the base must say on its terminal; with `all_or_said` only if it took not all
 * counts     the counter that must have grown
 * alarm_ms   how long an alarm may take
 */
// SPDX-License-Identifier: Apache-2.0

const kLaterMs = 50;
const web = (phase) => ({ alarms: [], steady: true, later_ms: kLaterMs, ...phase });

export const kWebPhases = [
  web({ name: "1,000 silent sockets", crowd: { kind: "silent", count: 1000 } }),
  web({ name: "1,000 requests that never end", crowd: { kind: "slow", count: 1000 } }),
  web({
    name: "1,000 consoles without a token",
    crowd: { kind: "refused", count: 1000 },
    counts: "pitwall_web_refused_total",
  }),
  web({ name: "50 viewers that mark at once", crowd: { kind: "marks", count: 50 } }),
  web({
    name: "250 viewers: places for operators",
    crowd: { kind: "viewers", count: 250 },
    counts: "pitwall_web_places_refused_total",
  }),
  web({
    name: "200 viewers, no descriptors",
    crowd: { kind: "viewers", count: 200 },
    limit: "descriptors",
    says: /console refused: file descriptors/,
    counts: "pitwall_web_short_refused_total",
  }),
  web({
    name: "200 viewers, memory 1.5 of idle",
    crowd: { kind: "viewers", count: 200 },
    limit: "memory",
    fresh: true,
    all_or_said: true,
    says: /console refused: memory/,
  }),
  web({
    name: "200 viewers, memory 1.1 of idle",
    crowd: { kind: "viewers", count: 200 },
    limit: "little_memory",
    fresh: true,
    says: /console refused: memory/,
    counts: "pitwall_web_short_refused_total",
  }),
  web({
    name: "200 viewers, a full disk",
    crowd: { kind: "viewers", count: 200 },
    limit: "disk",
    alarms: ["disk_full"],
    alarm_ms: 5000,
  }),
];
