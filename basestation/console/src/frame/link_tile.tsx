/**
 * The link in one tile: its state, loss, round trip and load, and above all the silence of a base
 * that this console itself no longer hears.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { ageText, kDash } from "../view/format";
import { kEachFrame, usePainter } from "../view/painting";
import { isSilent, liveMs } from "../view/timeline";
import { Value } from "../view/value";
import { showPage } from "./pages";

const kWords = { good: "GOOD", degraded: "DEGRADED", lost: "LOST" } as const;
const kJudged = { good: "good", degraded: "warning", lost: "bad" } as const;

export function LinkTile() {
  const word = useRef<HTMLSpanElement>(null);
  const root = useRef<HTMLButtonElement>(null);
  usePainter(
    () => {
      if (!word.current || !root.current) return;
      const local = performance.now();
      const state = session.link.value?.state;
      let text: string = state ? kWords[state] : kDash;
      let judged: string = state ? kJudged[state] : "none";
      if (isSilent()) {
        const silence = session.clock.silenceMs(local);
        text = Number.isFinite(silence) ? `NO BASE ${ageText(silence)}` : "NO BASE";
        judged = "bad";
      } else if (state === "lost" && session.link.value) {
        text = `LOST ${ageText(liveMs() - session.link.value.since_ms)}`;
      }
      if (word.current.textContent !== text) word.current.textContent = text;
      root.current.dataset.judgement = judged;
    },
    kEachFrame,
    [],
  );
  return (
    <button
      type="button"
      class="top-tile link-tile"
      ref={root}
      data-judgement="none"
      onClick={() => showPage("link")}
      title="link to the car"
    >
      <span class="detail">
        <span class="label">Link</span>
        <Value path="link.down_loss" scale={100} unit="%" decimals={1} live />
        <Value path="link.rtt_ms" unit="ms" decimals={0} live />
        <Value path="link.down_kbit_s" unit="kbit/s" decimals={0} live />
      </span>
      <span class="state">
        <i class="mark" aria-hidden="true" />
        <span ref={word} class="word" />
      </span>
    </button>
  );
}
