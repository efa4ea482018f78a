/**
 * In which world we are, and whose time it is: a bench's stands while the machine holds somebody
 * up, and what is on the screen then is neither old nor lost.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { ageText } from "../view/format";
import { kDigitsHz, kEachFrame, usePainter } from "../view/painting";
import { pauseMs } from "../view/timeline";

const kWords: Record<string, string> = {
  REAL: "REAL CAR",
  HIL: "HIL",
  REPLAY: "REPLAY",
  NONE: "NO CAR",
};
const kNoName = "\u00a0";

function BenchTime({ stoodMs }: { stoodMs: number }) {
  const root = useRef<HTMLSpanElement>(null);
  const span = useRef<HTMLSpanElement>(null);
  // With each frame, as the link's word: never beside one that says that nobody answers.
  usePainter(
    () => {
      const waits = String(pauseMs() !== null);
      if (root.current && root.current.dataset.waits !== waits) root.current.dataset.waits = waits;
    },
    kEachFrame,
    [],
  );
  usePainter(
    () => {
      const text = ageText(pauseMs() ?? stoodMs);
      if (span.current && span.current.textContent !== text) span.current.textContent = text;
    },
    kDigitsHz,
    [stoodMs],
  );
  return (
    <span
      class="bench-time"
      ref={root}
      data-waits="false"
      title="The time is a bench's. It stands while the machine is late; in all it stood so long."
    >
      <span class="goes-on">
        bench <span class="more">time, </span>stood
      </span>
      <span class="waits">bench waits</span> {/* Not read aloud with each tenth of a second. */}
      <span class="span" aria-hidden="true" ref={span} />
    </span>
  );
}

export function ModeWord() {
  const hello = session.hello.value;
  const mode = hello?.mode ?? "NONE";
  const car = hello?.car && mode !== "NONE" ? ` ${hello.car}` : "";
  const bench = session.benchTime.value;
  return (
    <div class="mode-word" role="status">
      <strong>{hello ? kWords[mode] + car : "NO BASE"}</strong>
      <span class="of">
        <span class="name">{hello?.name || (bench ? "" : kNoName)}</span>
        {bench && <BenchTime stoodMs={bench.stood_ms} />}
      </span>
    </div>
  );
}
