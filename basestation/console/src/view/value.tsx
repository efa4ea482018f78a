/**
 * One value of the car on the screen, with what it is worth: fresh as digits, late with its age,
 * stale kept but grey, struck, aged and without any colour, never an en dash. Warning and bad are a
 * filled shape behind the digits; a screen reader hears the word.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import type { Reading } from "../store/reading";
import type { FieldInfo } from "../wire/messages";
import { Quality, kJudgementNames, kQualityNames } from "../wire/status";
import { kDash, valueText } from "./format";
import { kDigitsHz, usePainter } from "./painting";
import { shownAge, stateWord } from "./shown";
import { shownDigits, shownUnit } from "./shown_unit";
import { read, readLive } from "./timeline";

export type TextOf = (value: number, info: FieldInfo) => string;

export interface ValueProps {
  path: string;
  decimals?: number;
  /** Multiplied for display instead of the factor of the unit shown: shares as percent. */
  scale?: number;
  unit?: string | false;
  hz?: number;
  /** Of the present moment even while the view is held. */
  live?: boolean;
  text?: TextOf;
  class?: string;
}

function put(element: Element | null | undefined, text: string): void {
  if (element && element.textContent !== text) element.textContent = text;
}

/** Writes quality and judgement where style sheet, tests and screen reader find them. */
export function markReading(element: HTMLElement, reading: Reading): void {
  const quality = kQualityNames[reading.quality];
  const judgement = kJudgementNames[reading.judgement];
  if (element.dataset.quality !== quality) element.dataset.quality = quality;
  if (element.dataset.judgement !== judgement) element.dataset.judgement = judgement;
  const unknown = String(reading.unknown);
  if (element.dataset.unknown !== unknown) element.dataset.unknown = unknown;
}

function digitsText(info: FieldInfo | undefined, reading: Reading, props: ValueProps): string {
  if (!info || reading.quality === Quality.never || !Number.isFinite(reading.value)) return kDash;
  if (props.text) return props.text(reading.value, info);
  if (props.scale) return valueText(info, reading.value * props.scale, props.decimals);
  return shownDigits(info, reading.value, props.decimals);
}

function unitOf(info: FieldInfo | undefined, props: ValueProps): string {
  if (props.unit !== undefined) return props.unit || "";
  return info ? shownUnit(info.unit).name : "";
}

export function Value(props: ValueProps) {
  const root = useRef<HTMLSpanElement>(null);
  const store = session.fields.value;
  const slot = store.slot(props.path);
  const info = store.info[slot];
  const unit = unitOf(info, props);
  usePainter(
    () => {
      const element = root.current;
      if (!element) return;
      const reading = props.live ? readLive(slot) : read(slot);
      markReading(element, reading);
      const [, word, digits, , age] = element.children;
      put(word, stateWord(reading));
      put(digits, digitsText(info, reading, props));
      put(age, shownAge(reading));
    },
    props.hz ?? kDigitsHz,
    [slot, info, props.decimals, props.scale, unit],
  );
  return (
    <span
      ref={root}
      class={`value ${props.class ?? ""}`}
      data-path={props.path}
      data-quality="never"
      data-judgement="none"
    >
      <i class="mark" aria-hidden="true" />
      <span class="sr-only" />
      <span class="digits">{kDash}</span>
      <span class="unit">{unit}</span>
      <span class="age" />
    </span>
  );
}

export interface TileProps extends ValueProps {
  label: string;
  big?: boolean;
}

/** A value under its name. */
export function Tile({ label, big, ...value }: TileProps) {
  return (
    <div class={big ? "tile big" : "tile"} role="group" aria-label={label}>
      <span class="label">{label}</span>
      <Value {...value} />
    </div>
  );
}

/** A value beside its name, for lists of many. */
export function Line({ label, ...value }: TileProps) {
  return (
    <div class="line" role="group" aria-label={label}>
      <span class="label">{label}</span>
      <Value {...value} />
    </div>
  );
}
