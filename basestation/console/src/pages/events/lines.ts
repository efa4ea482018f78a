/**
 * Lines of the event log: what the car told, what became of its alarms and what operators did, as
 * one list in the order of time.
 */
// SPDX-License-Identifier: Apache-2.0
import type { AlarmEvent, AuditLine, CarEvent, Mark } from "../../wire/messages";

export const kSources = ["car", "alarm", "operator"] as const;
export type Source = (typeof kSources)[number];

export interface EventLine {
  /** The message that the line is made of: the same as long as the line is there. */
  of: object;
  timeMs: number;
  source: Source;
  /** Severity, state of the alarm, or what came of it. */
  kind: string;
  what: string;
}

export interface EventLists {
  car: readonly CarEvent[];
  alarm: readonly AlarmEvent[];
  audit: readonly AuditLine[];
  marks: readonly Mark[];
}

const kStates: Record<string, string> = {
  unack: "new",
  acked: "acknowledged",
  rtn_unack: "gone, not seen",
  normal: "over",
};

const byWhom = (by?: string | null, reason?: string | null): string =>
  [by ? ` by ${by}` : "", reason ? `: ${reason}` : ""].join("");

/** Newest first; of one moment what came last is in front. */
export function eventLines(lists: EventLists, alarmText: (key: string) => string): EventLine[] {
  const lines: EventLine[] = [
    ...lists.car.map((it) => ({
      of: it,
      timeMs: it.time_ms,
      source: "car" as const,
      kind: String(it.severity),
      what: it.text,
    })),
    ...lists.alarm.map((it) => ({
      of: it,
      timeMs: it.time_ms,
      source: "alarm" as const,
      kind: kStates[it.to] ?? it.to,
      what: alarmText(it.key) + byWhom(it.by, it.reason),
    })),
    ...lists.audit.map((it) => ({
      of: it,
      timeMs: it.time_ms,
      source: "operator" as const,
      kind: it.result,
      what: `${it.who}: ${it.what}`,
    })),
    ...lists.marks.map((it) => ({
      of: it,
      timeMs: it.time_ms,
      source: "operator" as const,
      kind: "mark",
      what: it.by ? `${it.by}: ${it.text}` : it.text,
    })),
  ];
  return lines.reverse().sort((a, b) => b.timeMs - a.timeMs);
}

/** Those of the sources shown whose text, as it is shown, has every word. */
export function filterLines(
  lines: readonly EventLine[],
  shown: ReadonlySet<Source>,
  query: string,
  inUnits: (text: string) => string,
): EventLine[] {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  return lines.filter((line) => {
    if (!shown.has(line.source)) return false;
    if (words.length === 0) return true;
    const text = `${line.source} ${inUnits(line.kind)} ${inUnits(line.what)}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
}
