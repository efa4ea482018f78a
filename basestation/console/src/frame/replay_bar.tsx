/**
 * The recorder's bar of a replay: where in the file the base is, how fast it plays, and jumps.
 */
// SPDX-License-Identifier: Apache-2.0
import { useEffect } from "preact/hooks";
import * as session from "../store/session";
import { clockText, durationText } from "../view/format";
import { follow, loop, setMark } from "../view/loop";
import { changeSpeed, seekFile, step, togglePlay } from "../view/transport";

/** Sets A, then B, then ends the loop; says which of it comes next. */
function LoopButton({ beginMs }: { beginMs: number }) {
  useEffect(follow, []);
  const now = loop.value;
  const at = (ms: number) => durationText(ms - beginMs);
  const words = !now
    ? "Loop from A"
    : now.toMs === null
      ? `A ${at(now.fromMs)}, set B`
      : `${at(now.fromMs)} \u2013 ${at(now.toMs)}, end`;
  return (
    <button
      type="button"
      onClick={setMark}
      aria-pressed={now?.toMs != null}
      title="plays a piece of the recording again and again"
    >
      {words}
    </button>
  );
}

export function ReplayBar() {
  const playback = session.playback.value;
  if (!playback) return <footer class="dvr-bar">The base has not yet named its recording.</footer>;
  const { begin_ms, end_ms, now_ms, speed } = playback;
  return (
    <footer class="dvr-bar" data-held="true">
      <button type="button" onClick={togglePlay} aria-label={speed === 0 ? "play" : "pause"}>
        <i class={speed === 0 ? "glyph play" : "glyph pause"} aria-hidden="true" />
      </button>
      <button type="button" onClick={() => step(-10_000)} title="10 seconds back">
        &minus;10 s
      </button>
      <input
        type="range"
        min={begin_ms}
        max={end_ms}
        step={10}
        value={String(now_ms)}
        aria-label="moment of the recording"
        aria-valuetext={durationText(now_ms - begin_ms)}
        onChange={(e) => seekFile(Number(e.currentTarget.value))}
      />
      <button type="button" onClick={() => changeSpeed(false)} aria-label="slower">
        &minus;
      </button>
      <span class="speed">{speed === 0 ? "paused" : `${speed}\u00d7`}</span>
      <button type="button" onClick={() => changeSpeed(true)} aria-label="faster">
        +
      </button>
      <LoopButton beginMs={begin_ms} />
      <output class="behind">
        {durationText(now_ms - begin_ms)} / {durationText(end_ms - begin_ms)}
      </output>
      <span class="file-clock">{clockText(session.clock.utcMs(now_ms))} UTC</span>
    </footer>
  );
}
