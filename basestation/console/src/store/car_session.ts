/**
 * What this console knows of one car: signals for what changes seldom (who we are, alarms,
 * commands), typed arrays for what changes always (`fields`, `history`). Each car has a connection
 * of its own, and what is said on it cannot mean another car. A message of the base is taken in
 * here and nowhere else.
 */
// SPDX-License-Identifier: Apache-2.0
import { computed, signal } from "@preact/signals";
import type * as Wire from "../wire/messages";
import type { Checklist } from "../wire/pit";
import { Kind, readHead, readHistory, readSnapshot } from "../wire/frame";
import type { History as HistoryAnswer } from "../wire/frame";
import { readLap } from "../wire/laps";
import type { Laps } from "../wire/laps";
import { BaseSocket } from "../wire/socket";
import { Bench } from "./bench";
import { BaseClock } from "./station_clock";
import { Fields } from "./fields";
import type { Presence } from "./presence";
import { History } from "./history";
import { LapStore } from "./laps";

export const kKeptLines = 500;

export type StopKind = "controlled" | "emergency";

/** A stop that was asked for here, and whether it got as far as the base's socket. */
export interface LastStop {
  kind: StopKind;
  sent: boolean;
  at: number;
}

/** Adds a line to a bounded list, newest last. */
function keep<T>(list: readonly T[], line: T): readonly T[] {
  return list.length < kKeptLines ? [...list, line] : [...list.slice(1 - kKeptLines), line];
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

type Texts = Record<string, (message: never, localMs: number) => void>;

export class CarSession {
  readonly connected = signal(false);
  readonly presence = signal<Presence>("here");
  readonly hello = signal<Wire.Hello | null>(null);
  readonly fields = signal(new Fields([]));
  readonly history = signal(new History(0));
  readonly commands = signal<readonly Wire.CommandInfo[]>([]);
  readonly alarms = signal<Wire.Alarms | null>(null);
  readonly alarmEvents = signal<readonly Wire.AlarmEvent[]>([]);
  readonly authority = signal<Wire.Authority | null>(null);
  readonly ladder = signal<readonly Wire.CommandStep[]>([]);
  readonly audit = signal<readonly Wire.AuditLine[]>([]);
  readonly carEvents = signal<readonly Wire.CarEvent[]>([]);
  readonly marks = signal<readonly Wire.Mark[]>([]);
  readonly link = signal<Wire.Link | null>(null);
  readonly notices = signal<readonly Wire.Notice[]>([]);
  /** Null: the car is not stopped. */
  readonly stopState = signal<Wire.StopState | null>(null);
  readonly race = signal<Wire.RaceRules | null>(null);
  readonly fuel = signal<Wire.Fuel | null>(null);
  readonly expected = signal<Wire.Expected | null>(null);
  readonly settings = signal<Wire.Settings | null>(null);
  readonly checklist = signal<Checklist | null>(null);
  readonly playback = signal<Wire.Playback | null>(null);
  /** Null: this base goes by the wall clock. */
  readonly benchTime = signal<Wire.BenchTime | null>(null);
  readonly track = signal<Wire.Track | null>(null);
  readonly bench = new Bench();
  readonly laps = new LapStore();
  readonly lastError = signal<{ place: string; what: string; at: number } | null>(null);
  readonly lastStop = signal<LastStop | null>(null);

  /** Of a base that is there: nothing that a gone one would have to carry out looks possible. */
  readonly isOperator = computed(
    () =>
      this.hello.value?.role === "operator" &&
      this.hello.value.mode !== "REPLAY" &&
      this.presence.value !== "gone",
  );
  readonly isHolder = computed(
    () =>
      this.isOperator.value &&
      this.authority.value !== null &&
      this.authority.value.holder === this.hello.value?.client,
  );

  readonly clock = new BaseClock();
  /** Counts frames and texts that could not be used, and what the base dropped for us. */
  readonly counters = { frames: 0, badFrames: 0, badTexts: 0, dropped: 0, refreshed: 0 };

  private socket: BaseSocket | null = null;
  private readonly historyWaiters = new Map<number, ((answer: HistoryAnswer) => void)[]>();

  /** Of the car with this number; null: the first, or the only one, of the base. */
  constructor(public number: number | null = null) {}

  open(url: string): void {
    this.socket = new BaseSocket(url, {
      opened: () => {
        this.laps.forget();
        this.connected.value = true;
      },
      closed: () => this.lose(),
      text: (message) => this.takeText(message),
      binary: (view) => this.takeBinary(view, performance.now()),
      unreadable: () => ++this.counters.badTexts,
    });
    this.socket.connect();
  }

  send(message: { type: string } & Record<string, unknown>): boolean {
    return this.socket?.send(message) ?? false;
  }

  stop(kind: StopKind): void {
    if (this.hello.value?.mode === "REPLAY") return;
    const sent = this.send({ type: "stop", kind });
    this.lastStop.value = { kind, sent, at: performance.now() };
  }

  takeCatalogue(catalogue: Wire.Catalogue): void {
    const known = this.fields.value.info;
    const same =
      known.length === catalogue.fields.length &&
      known.every((f, i) => f.id === catalogue.fields[i].id && f.path === catalogue.fields[i].path);
    this.commands.value = catalogue.commands;
    this.race.value = catalogue.race;
    if (same) {
      known.forEach((f, i) => (f.limits = catalogue.fields[i].limits));
      return;
    }
    this.history.value = new History(catalogue.fields.length);
    this.fields.value = new Fields(catalogue.fields);
  }

  takeBinary(view: DataView, localMs: number): void {
    const head = readHead(view);
    if (head === null) {
      ++this.counters.badFrames;
      return;
    }
    if (head.kind === Kind.lap) {
      const points = readLap(view);
      if (points === null) ++this.counters.badFrames;
      else this.laps.take(points, head.timeMs, this.hello.value?.mode === "REPLAY");
      return;
    }
    if (head.kind === Kind.history) {
      const answer = readHistory(view);
      if (answer === null) ++this.counters.badFrames;
      else
        this.historyWaiters
          .get(answer.field)
          ?.splice(0)
          .forEach((waiter) => waiter(answer));
      return;
    }
    const store = this.fields.value;
    const good = readSnapshot(view, head, (id, status, age, value) =>
      store.write(id, status, age, value, head.timeMs),
    );
    if (!good) {
      ++this.counters.badFrames;
      return;
    }
    ++this.counters.frames;
    this.counters.dropped = head.dropped;
    this.clock.received(head.timeMs, localMs);
    this.history.value.append(store, head.timeMs);
  }

  takeText(message: { type: string }, localMs = performance.now()): void {
    const take = Object.hasOwn(this.texts, message.type) ? this.texts[message.type] : undefined;
    if (take) take(message as never, localMs);
    else ++this.counters.badTexts;
  }

  /** Calls back once with the next history answer for the field of this id. */
  awaitHistory(field: number, waiter: (answer: HistoryAnswer) => void): void {
    const waiters = this.historyWaiters.get(field);
    if (waiters) waiters.push(waiter);
    else this.historyWaiters.set(field, [waiter]);
  }

  /** The next base at this address may go by another clock. */
  private lose(): void {
    this.connected.value = false;
    if (this.hello.value) this.presence.value = "gone";
    this.benchTime.value = null;
    this.clock.goesOn();
  }

  /** After a jump of a replay the base tells everything again: what was known lies elsewhere. */
  private forget(): void {
    this.history.value = new History(this.fields.value.info.length);
    this.fields.value = new Fields(this.fields.value.info);
    this.alarmEvents.value = [];
    this.ladder.value = [];
    this.audit.value = [];
    this.carEvents.value = [];
    this.marks.value = [];
    this.notices.value = [];
    this.stopState.value = null;
  }

  private readonly texts: Texts = {
    hello: (m: Wire.Hello) => {
      this.hello.value = m;
      this.presence.value = "here";
      this.clock.tiesToUtc(m.time_ns / 1e6, m.utc_ms);
    },
    catalogue: (m: Wire.Catalogue) => this.takeCatalogue(m),
    alarms: (m: Wire.Alarms) => (this.alarms.value = m),
    alarm_event: (m: Wire.AlarmEvent) => (this.alarmEvents.value = keep(this.alarmEvents.value, m)),
    authority: (m: Wire.Authority) => (this.authority.value = m),
    command: (m: Wire.CommandStep) => (this.ladder.value = climb(this.ladder.value, m)),
    audit: (m: Wire.AuditLine) => (this.audit.value = keep(this.audit.value, m)),
    event: (m: Wire.CarEvent) => (this.carEvents.value = keep(this.carEvents.value, m)),
    link: (m: Wire.Link) => (this.link.value = m),
    notice: (m: Wire.Notice) =>
      (this.notices.value = [...this.notices.value.filter((n) => n.id !== m.id), m].slice(-20)),
    stop_state: (m: Wire.StopState) => (this.stopState.value = m.stopped ? m : null),
    fuel: (m: Wire.Fuel) => (this.fuel.value = m),
    expected: (m: Wire.Expected) => (this.expected.value = m),
    settings: (m: Wire.Settings) => (this.settings.value = m),
    checklist: (m: Checklist) => (this.checklist.value = m),
    playback: (m: Wire.Playback) => {
      const before = this.playback.value;
      if (before && before.jumps !== m.jumps) this.forget();
      this.playback.value = m;
    },
    laps: (m: Laps) => (this.laps.table.value = m),
    bench_time: (m: Wire.BenchTime, localMs: number) => {
      this.benchTime.value = m;
      this.clock.stands(m.time_ms, m.stands_ms, localMs);
    },
    ...this.bench.texts,
    pong: () => {},
    mark: (m: Wire.Mark) => (this.marks.value = keep(this.marks.value, m)),
    layout: () => {},
    error: (m: { place: string; what: string }) =>
      (this.lastError.value = { place: m.place, what: m.what, at: performance.now() }),
  };
}
