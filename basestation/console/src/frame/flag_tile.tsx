/**
 * The flags as the car received them, drawn as flags: colour, word and age. A flag that is stale
 * has no colour, because nobody knows it any more.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { kDash } from "../view/format";
import { kEachFrame, usePainter } from "../view/painting";
import { flagColour, flagWord, shownAge } from "../view/shown";
import { readLive } from "../view/timeline";
import { markReading } from "../view/value";

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
      const word = store.info[slot]?.labels?.[reading.value];
      element.dataset.flag = flagColour(reading, word);
      const [, , digits, age] = element.children;
      const text = flagWord(reading, word);
      if (digits.textContent !== text) {
        digits.textContent = text;
        element.dataset.words = text.includes(" ") ? "several" : "one";
      }
      const ageNow = shownAge(reading);
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
