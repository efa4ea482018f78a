/**
 * Every field that there is, by group: title, path, value, age against its period, how often it
 * comes, extremes of the last minute. Only the rows in sight exist; a row opens its plot.
 */
// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef, useState } from "preact/hooks";
import * as session from "../../store/session";
import { plotTarget } from "../plots/finder_target";
import { showPage } from "../../frame/pages";
import { FieldRow, kRowPx } from "./row";
import { rateTable } from "./rates";
import { findFields } from "../../view/find_fields";
import { addPainter } from "../../view/painting";
import { useRowsInSight } from "../../view/rows_in_sight";

function plot(path: string): void {
  plotTarget.add(null, path);
  showPage("plots");
}

export function TelemetryPage() {
  const box = useRef<HTMLDivElement>(null);
  const [query, setQuery] = useState("");
  const [at, setAt] = useState(0);
  const all = session.fields.value.info;
  const shown = query ? findFields(all, query) : all;

  const { first, count, page, setTop } = useRowsInSight(box, kRowPx);
  useEffect(() => addPainter(() => rateTable.sample(session.fields.value), 1), []);

  const rows = shown.slice(first, first + count);
  const go = (to: number) => {
    const next = Math.min(Math.max(to, 0), shown.length - 1);
    setAt(next);
    const element = box.current;
    if (!element) return;
    if (next * kRowPx < element.scrollTop) element.scrollTop = next * kRowPx;
    const bottom = (next + 1) * kRowPx - element.clientHeight;
    if (bottom > element.scrollTop) element.scrollTop = bottom;
  };

  return (
    <main class="page telemetry">
      <div class="tools">
        <input
          type="search"
          placeholder="filter by name or path"
          value={query}
          spellcheck={false}
          aria-label="filter fields"
          onInput={(e) => {
            setQuery(e.currentTarget.value);
            setAt(0);
          }}
        />
        <span class="count" role="status">
          {shown.length} of {all.length} fields
        </span>
      </div>
      <div class="field-head" aria-hidden="true">
        <span>field</span>
        <span>value</span>
        <span>age</span>
        <span>rate</span>
        <span>least 60 s</span>
        <span>most 60 s</span>
        <span>group every</span>
      </div>
      <div
        class="field-box"
        ref={box}
        role="grid"
        tabIndex={0}
        aria-label="all fields"
        aria-rowcount={shown.length}
        aria-activedescendant={`field-${shown[at]?.id}`}
        onScroll={(e) => setTop(e.currentTarget.scrollTop)}
        onKeyDown={(e) => {
          if (e.key === "ArrowDown") go(at + 1);
          else if (e.key === "ArrowUp") go(at - 1);
          else if (e.key === "PageDown") go(at + page - 1);
          else if (e.key === "PageUp") go(at - page + 1);
          else if (e.key === "Enter" && shown[at]) plot(shown[at].path);
          else return;
          e.preventDefault();
        }}
      >
        <div
          class="field-rows"
          role="presentation"
          style={{ height: `${shown.length * kRowPx}px` }}
        >
          {rows.map((field, i) => (
            <FieldRow
              key={field.id}
              field={field}
              row={first + i}
              selected={first + i === at}
              onOpen={() => plot(field.path)}
            />
          ))}
        </div>
      </div>
    </main>
  );
}
