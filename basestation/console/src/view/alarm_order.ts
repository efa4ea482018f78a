/**
 * Which alarm comes first, and how many there are of each priority.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Alarm } from "../wire/messages";

export const kPriorities = ["high", "medium", "low"] as const;
export type Priority = (typeof kPriorities)[number];

export const needsEyes = (alarm: Alarm): boolean =>
  alarm.state === "unack" || alarm.state === "rtn_unack" || alarm.state === "latched";

/** Not yet seen before seen, high before low, newest first. */
export function inOrder(alarms: readonly Alarm[]): Alarm[] {
  const rank = (alarm: Alarm) => kPriorities.indexOf(alarm.priority) + (needsEyes(alarm) ? 0 : 10);
  return [...alarms].sort((a, b) => rank(a) - rank(b) || b.since_ms - a.since_ms);
}

export const countOf = (alarms: readonly Alarm[], priority: Priority): number =>
  alarms.filter((alarm) => alarm.priority === priority).length;

/** The newest alarm of the highest priority that nobody has acknowledged. */
export const loudest = (alarms: readonly Alarm[]): Alarm | undefined =>
  inOrder(alarms).find(needsEyes);
