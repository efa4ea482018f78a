/**
 * What this console knows: signals for what changes seldom (who we are, alarms, commands), typed
 * arrays for what changes always (`fields`, `history`). One per page; a message of the base is
 * taken in here and nowhere else.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import type * as Wire from "../wire/messages";
import type { Checklist } from "../wire/pit";
import { Kind, readHead, readHistory, readSnapshot } from "../wire/frame";
import type { History as HistoryAnswer } from "../wire/frame";
import { BaseClock } from "./station_clock";
import { Fields } from "./fields";
import { History } from "./history";

export const kKeptLines = 500;

export const connected = signal(false);
export const hello = signal<Wire.Hello | null>(null);
export const fields = signal(new Fields([]));
export const commands = signal<readonly Wire.CommandInfo[]>([]);
export const alarms = signal<Wire.Alarms | null>(null);
export const alarmEvents = signal<readonly Wire.AlarmEvent[]>([]);
export const authority = signal<Wire.Authority | null>(null);
export const ladder = signal<readonly Wire.CommandStep[]>([]);
export const audit = signal<readonly Wire.AuditLine[]>([]);
export const carEvents = signal<readonly Wire.CarEvent[]>([]);
export const link = signal<Wire.Link | null>(null);
export const notices = signal<readonly Wire.Notice[]>([]);
export const fuel = signal<Wire.Fuel | null>(null);
export const expected = signal<Wire.Expected | null>(null);
export const settings = signal<Wire.Settings | null>(null);
export const checklist = signal<Checklist | null>(null);
export const playback = signal<Wire.Playback | null>(null);
export const track = signal<Wire.Track | null>(null);
export const lastError = signal<{ place: string; what: string; at: number } | null>(null);

export const clock = new BaseClock();
export let history = new History(0);
/** Counts frames and texts that could not be used, and what the base dropped for us. */
export const counters = { frames: 0, badFrames: 0, badTexts: 0, dropped: 0, refreshed: 0 };

const historyWaiters = new Map<number, ((answer: HistoryAnswer) => void)[]>();

/** Adds a line to a bounded list, newest last. */
function keep<T>(list: readonly T[], line: T): readonly T[] {
  return list.length < kKeptLines ? [...list, line] : [...list.slice(1 - kKeptLines), line];
}

export function takeCatalogue(catalogue: Wire.Catalogue): void {
  const known = fields.value.info;
  const same =
    known.length === catalogue.fields.length &&
    known.every((f, i) => f.id === catalogue.fields[i].id && f.path === catalogue.fields[i].path);
  commands.value = catalogue.commands;
  if (same) {
    known.forEach((f, i) => (f.limits = catalogue.fields[i].limits));
    return;
  }
  history = new History(catalogue.fields.length);
  fields.value = new Fields(catalogue.fields);
}

export function takeBinary(view: DataView, localMs: number): void {
  const head = readHead(view);
  if (head === null) {
    ++counters.badFrames;
    return;
  }
  if (head.kind === Kind.history) {
    const answer = readHistory(view);
    if (answer === null) ++counters.badFrames;
    else
      historyWaiters
        .get(answer.field)
        ?.splice(0)
        .forEach((waiter) => waiter(answer));
    return;
  }
  const store = fields.value;
  const good = readSnapshot(view, head, (id, status, age, value) =>
    store.write(id, status, age, value, head.timeMs),
  );
  if (!good) {
    ++counters.badFrames;
    return;
  }
  ++counters.frames;
  counters.dropped = head.dropped;
  clock.heard(head.timeMs, localMs);
  history.append(store, head.timeMs);
}

/** Calls back once with the next history answer for the field of this id. */
export function awaitHistory(field: number, waiter: (answer: HistoryAnswer) => void): void {
  const waiters = historyWaiters.get(field);
  if (waiters) waiters.push(waiter);
  else historyWaiters.set(field, [waiter]);
}

/** A new step replaces the last known one of its ticket, and keeps the gates it does not repeat. */
function climb(known: readonly Wire.CommandStep[], step: Wire.CommandStep): Wire.CommandStep[] {
  const before = known.find((s) => s.ticket === step.ticket);
  const merged = before
    ? { ...before, ...step, times_ms: { ...before.times_ms, ...step.times_ms } }
    : step;
  if (before && !step.gates?.length) merged.gates = before.gates;
  return [...known.filter((s) => s.ticket !== step.ticket), merged].slice(-kKeptLines);
}

/** After a jump of a replay the base tells everything again: what was known lies elsewhere. */
function forget(): void {
  history = new History(fields.value.info.length);
  fields.value = new Fields(fields.value.info);
  alarmEvents.value = ladder.value = audit.value = carEvents.value = [];
  notices.value = [];
}

function takePlayback(message: Wire.Playback): void {
  const before = playback.value;
  if (before && before.jumps !== message.jumps) forget();
  playback.value = message;
}

type Texts = Record<string, (message: never) => void>;

const kTexts: Texts = {
  hello: (m: Wire.Hello) => {
    hello.value = m;
    clock.tiesToUtc(m.time_ns / 1e6, m.utc_ms);
  },
  catalogue: (m: Wire.Catalogue) => takeCatalogue(m),
  alarms: (m: Wire.Alarms) => (alarms.value = m),
  alarm_event: (m: Wire.AlarmEvent) => (alarmEvents.value = keep(alarmEvents.value, m)),
  authority: (m: Wire.Authority) => (authority.value = m),
  command: (m: Wire.CommandStep) => (ladder.value = climb(ladder.value, m)),
  audit: (m: Wire.AuditLine) => (audit.value = keep(audit.value, m)),
  event: (m: Wire.CarEvent) => (carEvents.value = keep(carEvents.value, m)),
  link: (m: Wire.Link) => (link.value = m),
  notice: (m: Wire.Notice) =>
    (notices.value = [...notices.value.filter((n) => n.id !== m.id), m].slice(-20)),
  fuel: (m: Wire.Fuel) => (fuel.value = m),
  expected: (m: Wire.Expected) => (expected.value = m),
  settings: (m: Wire.Settings) => (settings.value = m),
  checklist: (m: Checklist) => (checklist.value = m),
  playback: takePlayback,
  pong: () => {},
  layout: () => {},
  error: (m: { place: string; what: string }) =>
    (lastError.value = { place: m.place, what: m.what, at: performance.now() }),
};

export function takeText(message: { type: string }): void {
  const take = Object.hasOwn(kTexts, message.type) ? kTexts[message.type] : undefined;
  if (take) take(message as never);
  else ++counters.badTexts;
}

export const dismissNotice = (id: number): void => {
  notices.value = notices.value.filter((notice) => notice.id !== id);
};
