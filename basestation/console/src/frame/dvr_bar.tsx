/**
 * The recorder's bar at the foot of the page: pause, scrub through the last ten minutes, play at
 * another speed, back to live. Moves only what this console shows.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { durationText, kDash } from "../view/format";
import { kGaugesHz, usePainter } from "../view/painting";
import * as timeline from "../view/timeline";
import { mark } from "./keys";

const kSpanS = 600;

/** "-12.4 s": how far behind the present the view is. */
export function behindText(behindMs: number): string {
  const s = Math.max(0, behindMs) / 1000;
  return s < 60 ? `\u2212${s.toFixed(1)} s` : `\u2212${durationText(behindMs)}`;
}

export function DvrBar() {
  const slider = useRef<HTMLInputElement>(null);
  const behind = useRef<HTMLOutputElement>(null);
  const held = !timeline.isLive.value;
  const speed = timeline.speed.value;
  usePainter(
    () => {
      if (!slider.current || !behind.current) return;
      const newest = session.history.newestMs();
      const back = held ? newest - timeline.shownMs() : 0;
      if (document.activeElement !== slider.current || !held) {
        slider.current.value = String(-back / 1000);
      }
      const now = session.presence.value === "here" ? "LIVE" : "NO BASE";
      const text = held ? behindText(timeline.liveMs() - timeline.shownMs()) : now;
      behind.current.value = text;
      slider.current.setAttribute("aria-valuetext", text);
    },
    kGaugesHz,
    [held],
  );
  return (
    <footer class="dvr-bar" data-held={held}>
      <button
        type="button"
        onClick={timeline.togglePlay}
        aria-label={held && speed === 0 ? "play" : "pause"}
      >
        <i class={held && speed === 0 ? "glyph play" : "glyph pause"} aria-hidden="true" />
      </button>
      <button type="button" onClick={() => timeline.step(-10_000)} title="10 seconds back">
        &minus;10 s
      </button>
      <input
        type="range"
        ref={slider}
        min={-kSpanS}
        max={0}
        step={0.04}
        defaultValue="0"
        aria-label="moment shown, seconds before now"
        onInput={(e) => {
          timeline.speed.value = 0;
          timeline.seek(session.history.newestMs() + Number(e.currentTarget.value) * 1000);
        }}
      />
      <button type="button" onClick={() => timeline.changeSpeed(false)} aria-label="slower">
        &minus;
      </button>
      <span class="speed">{held ? `${speed}\u00d7` : "1\u00d7"}</span>
      <button type="button" onClick={() => timeline.changeSpeed(true)} aria-label="faster">
        +
      </button>
      <output ref={behind} class="behind">
        {kDash}
      </output>
      <button type="button" class="to-live" onClick={timeline.backToLive} disabled={!held}>
        Live <kbd>L</kbd>
      </button>
      <button
        type="button"
        class="mark-button"
        onClick={mark}
        disabled={session.presence.value === "gone"}
      >
        Mark <kbd>M</kbd>
      </button>
    </footer>
  );
}
