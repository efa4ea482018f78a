/**
 * One field as a row of the table of all telemetry.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../../store/session";
import { kDash } from "../../view/format";
import { kDigitsHz, usePainter } from "../../view/painting";
import { shownDigits } from "../../view/shown_unit";
import { read, shownMs } from "../../view/timeline";
import { Value } from "../../view/value";
import type { FieldInfo } from "../../wire/messages";
import { extremes, rateTable } from "./rates";

export const kRowPx = 32;
const kSpanMs = 60_000;
/** The age bar is full at this many periods, where a value becomes stale. */
const kPeriodsShown = 5;

export interface FieldRowProps {
  field: FieldInfo;
  row: number;
  selected: boolean;
  onOpen: () => void;
}

export function FieldRow({ field, row, selected, onOpen }: FieldRowProps) {
  const root = useRef<HTMLDivElement>(null);
  const slot = session.fields.value.slotOf(field.id);
  usePainter(
    () => {
      const [, , age, rate, least, most] = [...(root.current?.children ?? [])] as HTMLElement[];
      if (!age) return;
      const { ageMs, quality } = read(slot);
      const share = field.period_ms > 0 ? ageMs / (kPeriodsShown * field.period_ms) : 0;
      const fill = age.firstElementChild as HTMLElement;
      fill.style.width = Number.isFinite(ageMs) ? `${(Math.min(share, 1) * 100).toFixed(1)}%` : "0";
      age.dataset.quality = String(quality);
      const hz = rateTable.rate(slot);
      rate.textContent = Number.isFinite(hz) ? `${hz.toFixed(hz < 10 ? 1 : 0)} Hz` : kDash;
      const span = field.labels?.length
        ? null
        : extremes(session.history, slot, shownMs() - kSpanMs);
      least.textContent = span ? shownDigits(field, span.least) : kDash;
      most.textContent = span ? shownDigits(field, span.most) : kDash;
    },
    kDigitsHz / 2,
    [slot, field],
  );
  return (
    <div
      class="field-row"
      ref={root}
      id={`field-${field.id}`}
      role="row"
      aria-rowindex={row + 1}
      aria-selected={selected}
      data-selected={selected}
      draggable
      style={{ top: `${row * kRowPx}px` }}
      onDragStart={(e) => e.dataTransfer?.setData("text/plain", field.path)}
      onClick={onOpen}
    >
      <span role="gridcell" class="named">
        <b>{field.title}</b>
        <span class="path">{field.path}</span>
      </span>
      <span role="gridcell">
        <Value path={field.path} />
      </span>
      <span role="gridcell" class="age-bar">
        <i />
      </span>
      <span role="gridcell" class="number">
        {kDash}
      </span>
      <span role="gridcell" class="number">
        {kDash}
      </span>
      <span role="gridcell" class="number">
        {kDash}
      </span>
      <span role="gridcell" class="number">
        {field.period_ms} ms
      </span>
    </div>
  );
}
