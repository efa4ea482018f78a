/**
 * A horizontal scale: what is, filled; what was asked for, hollow; ticks where a border lies. Loses
 * its fill's colour with its value's age, like the digits.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { Quality } from "../wire/status";
import { kGaugesHz, usePainter } from "./painting";
import { read } from "./timeline";
import { markReading } from "./value";

export interface BarTick {
  at?: number;
  path?: string;
  label: string;
}

export interface BarProps {
  path: string;
  label: string;
  min?: number;
  max: number;
  /** Field of the value that was asked for. */
  asked?: string;
  ticks?: readonly BarTick[];
  /** Filled from zero to both sides. */
  centred?: boolean;
}

const kShown = Quality.late;

export function Bar({ path, label, min = 0, max, asked, ticks = [], centred }: BarProps) {
  const root = useRef<HTMLDivElement>(null);
  const store = session.fields.value;
  const slots = {
    actual: store.slot(path),
    asked: asked ? store.slot(asked) : -1,
    ticks: ticks.map((tick) => (tick.path ? store.slot(tick.path) : -1)),
  };
  const share = (value: number) => Math.min(Math.max((value - min) / (max - min), 0), 1);

  const place = (element: HTMLElement, slot: number) => {
    const reading = read(slot);
    const shown = reading.quality <= kShown && Number.isFinite(reading.value);
    element.hidden = !shown;
    if (shown) element.style.left = `${(share(reading.value) * 100).toFixed(2)}%`;
  };

  usePainter(
    () => {
      const element = root.current;
      if (!element) return;
      const [fill, hollow, ...lines] = [...element.children] as HTMLElement[];
      const reading = read(slots.actual);
      markReading(element, reading);
      const at = Number.isFinite(reading.value) ? share(reading.value) : 0;
      const zero = centred ? share(0) : 0;
      fill.style.left = `${(Math.min(at, zero) * 100).toFixed(2)}%`;
      fill.style.width = `${(Math.abs(at - zero) * 100).toFixed(2)}%`;
      if (asked) place(hollow, slots.asked);
      slots.ticks.forEach((slot, i) => {
        if (slot >= 0) place(lines[i], slot);
        else if (ticks[i].at !== undefined) {
          lines[i].style.left = `${(share(ticks[i].at) * 100).toFixed(2)}%`;
        } else lines[i].hidden = true;
      });
    },
    kGaugesHz,
    [store, path, asked, max],
  );

  return (
    <div class="bar" ref={root} role="img" aria-label={label}>
      <i class="fill" />
      <i class="asked" hidden />
      {ticks.map((tick) => (
        <i class="tick" key={tick.label} title={tick.label} />
      ))}
    </div>
  );
}
