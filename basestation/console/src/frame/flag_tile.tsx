/**
 * The flags as the car received them, drawn as flags: colour, word and age. A flag that is stale
 * has no colour, because nobody knows it any more.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { Quality } from "../wire/status";
import { ageText, kDash } from "../view/format";
import { kEachFrame, usePainter } from "../view/painting";
import { readLive } from "../view/timeline";
import { markReading } from "../view/value";

/** The colour of a flag by a word of its label. */
const kColours: readonly (readonly [RegExp, string])[] = [
  [/PURPLE/, "purple"],
  [/RED|STOP|KILL/, "red"],
  [/ORANGE/, "orange"],
  [/YELLOW/, "yellow"],
  [/GREEN/, "green"],
  [/CHEQUERED/, "chequered"],
  [/BLUE/, "blue"],
  [/BLACK/, "black"],
];

export const flagColour = (label: string): string =>
  kColours.find(([word]) => word.test(label))?.[1] ?? "none";

export function Flag({ path, label }: { path: string; label: string }) {
  const root = useRef<HTMLDivElement>(null);
  const store = session.fields.value;
  const slot = store.slot(path);
  usePainter(
    () => {
      const element = root.current;
      if (!element) return;
      const reading = readLive(slot);
      markReading(element, reading);
      const known = reading.quality < Quality.stale;
      const word = store.info[slot]?.labels?.[reading.value];
      element.dataset.flag = known && word ? flagColour(word) : "none";
      const [, , digits, age] = element.children;
      const text = reading.quality === Quality.never ? kDash : (word ?? kDash);
      if (digits.textContent !== text) {
        digits.textContent = text;
        element.dataset.words = text.includes(" ") ? "several" : "one";
      }
      const old = reading.quality === Quality.late || reading.quality === Quality.stale;
      const ageNow = old ? ageText(reading.ageMs) : "";
      if (age.textContent !== ageNow) age.textContent = ageNow;
    },
    kEachFrame,
    [store, slot],
  );
  return (
    <div
      class="flag value"
      ref={root}
      role="group"
      aria-label={label}
      data-path={path}
      data-quality="never"
      data-judgement="none"
    >
      <span class="label">{label}</span>
      <i class="cloth" aria-hidden="true" />
      <span class="digits">{kDash}</span>
      <span class="age" />
    </div>
  );
}
