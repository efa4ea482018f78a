/**
 * The event log, live: events of the car, its alarms and what operators did, newest first. New
 * lines come in above; who reads further down keeps the line at the top of the box. Only the rows
 * in sight exist.
 */
// SPDX-License-Identifier: Apache-2.0
import { computed } from "@preact/signals";
import { useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import * as session from "../../store/session";
import { clockText } from "../../view/format";
import { useRowsInSight } from "../../view/rows_in_sight";
import { saveTsv, tsvText } from "../../view/save_lines";
import { speedUnit } from "../../view/speed_unit";
import { inDisplayUnits } from "../../view/display_units";
import { eventLines, filterLines, kSources } from "./lines";
import type { EventLine, Source } from "./lines";
import "./events.css";

const kRowPx = 32;
const kColumns = ["UTC", "source", "kind", "what"];

/** What each alarm is called: as its settings say, else as it was last received, else its key. */
const alarmTexts = computed(() => {
  const alarms = session.alarms.value;
  const known = alarms ? [...alarms.active, ...alarms.shelved, ...alarms.suppressed] : [];
  const texts = [...known, ...(session.settings.value?.alarms ?? [])];
  return new Map(texts.map(({ key, text }) => [key, text]));
});

const allLines = computed(() =>
  eventLines(
    {
      car: session.carEvents.value,
      alarm: session.alarmEvents.value,
      audit: session.audit.value,
      marks: session.marks.value,
    },
    (key) => alarmTexts.value.get(key) ?? key.replaceAll("_", " "),
  ),
);

function save(lines: readonly EventLine[]): void {
  const cells = lines.map(({ timeMs, source, kind, what }) => [
    new Date(session.clock.utcMs(timeMs)).toISOString(),
    source,
    kind,
    what,
  ]);
  saveTsv("pitwall_events.tsv", tsvText(["utc", "source", "kind", "what"], cells));
}

function EventRow({ line, row }: { line: EventLine; row: number }) {
  return (
    <div
      class="event-row"
      role="row"
      aria-rowindex={row + 2}
      data-source={line.source}
      data-kind={line.kind}
      style={{ top: `${row * kRowPx}px` }}
    >
      <span role="cell">{clockText(session.clock.utcMs(line.timeMs), 1)}</span>
      <span role="cell">{line.source}</span>
      <span role="cell" class="kind">
        {inDisplayUnits(line.kind)}
      </span>
      <span role="cell" class="what" title={inDisplayUnits(line.what)}>
        {inDisplayUnits(line.what)}
      </span>
    </div>
  );
}

/** The lines in a box that scrolls; the line at its top stays there when others come in above. */
function EventTable({ lines }: { lines: readonly EventLine[] }) {
  const box = useRef<HTMLDivElement>(null);
  const held = useRef<{ of: object; px: number } | null>(null);
  const { first, count, setTop } = useRowsInSight(box, kRowPx);
  useLayoutEffect(() => {
    const element = box.current;
    const at = held.current ? lines.findIndex((line) => line.of === held.current?.of) : -1;
    if (!element || !held.current || at < 0) return;
    element.scrollTop = at * kRowPx + held.current.px;
    setTop(element.scrollTop);
  }, [lines]);
  const scrolled = (element: HTMLElement) => {
    const line = lines[Math.floor(element.scrollTop / kRowPx)];
    const px = element.scrollTop % kRowPx;
    held.current = element.scrollTop > 0 && line ? { of: line.of, px } : null;
    setTop(element.scrollTop);
  };
  return (
    <div class="event-table" role="table" aria-label="events" aria-rowcount={lines.length + 1}>
      <div class="event-head" role="row">
        {kColumns.map((name) => (
          <span role="columnheader" key={name}>
            {name}
          </span>
        ))}
      </div>
      <div
        class="event-box"
        ref={box}
        role="rowgroup"
        aria-label="lines of the log"
        tabIndex={0}
        onScroll={(e) => scrolled(e.currentTarget)}
      >
        <div
          class="event-rows"
          role="presentation"
          style={{ height: `${lines.length * kRowPx}px` }}
        >
          {lines.slice(first, first + count).map((line, i) => (
            <EventRow line={line} row={first + i} key={keyOf(line)} />
          ))}
        </div>
      </div>
    </div>
  );
}

const keys = new WeakMap<object, number>();
let keysGiven = 0;

/** A line keeps its element while others come in above it. */
function keyOf({ of }: EventLine): number {
  const known = keys.get(of) ?? ++keysGiven;
  keys.set(of, known);
  return known;
}

export function EventsPage() {
  const [query, setQuery] = useState("");
  const [shown, setShown] = useState<ReadonlySet<Source>>(new Set(kSources));
  const all = allLines.value;
  const unit = speedUnit.value;
  const lines = useMemo(
    () => filterLines(all, shown, query, inDisplayUnits),
    [all, shown, query, unit],
  );
  const toggle = (source: Source) =>
    setShown(new Set(kSources.filter((each) => shown.has(each) !== (each === source))));
  return (
    <main class="page events-page">
      <div class="tools">
        {kSources.map((source) => (
          <button
            type="button"
            key={source}
            aria-pressed={shown.has(source)}
            onClick={() => toggle(source)}
          >
            {source}
          </button>
        ))}
        <input
          type="search"
          placeholder="filter by text"
          aria-label="filter events"
          spellcheck={false}
          value={query}
          onInput={(e) => setQuery(e.currentTarget.value)}
        />
        <span class="count-of">
          {lines.length} of {all.length}
        </span>
        <button type="button" disabled={lines.length === 0} onClick={() => save(lines)}>
          Save
        </button>
      </div>
      <EventTable lines={lines} />
      {lines.length === 0 && (
        <p class="empty" role="status">
          {all.length === 0
            ? "Nothing yet: events of the car, alarms and what operators do are listed here."
            : "No line passes the filter."}
        </p>
      )}
    </main>
  );
}
