/**
 * How long ago a moment of the base's clock was, counted on while it is shown.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import { kDash, durationText } from "./format";
import { kDigitsHz, usePainter } from "./painting";
import { liveMs } from "./timeline";

export function AgeSince({ sinceMs }: { sinceMs: number }) {
  const root = useRef<HTMLSpanElement>(null);
  usePainter(
    () => {
      if (!root.current) return;
      const text = Number.isFinite(sinceMs) ? durationText(liveMs() - sinceMs) : kDash;
      if (root.current.textContent !== text) root.current.textContent = text;
    },
    kDigitsHz,
    [sinceMs],
  );
  return <span class="since" ref={root} aria-hidden="true" />;
}
