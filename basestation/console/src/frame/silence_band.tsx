/**
 * Over the whole width while the base does not answer: for how long, whether a stop still goes out
 * from here, and what remains to be done.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { ageText } from "../view/format";
import { kDigitsHz, usePainter } from "../view/painting";

function Silence() {
  const root = useRef<HTMLSpanElement>(null);
  usePainter(
    () => {
      if (!root.current) return;
      const silence = session.clock.silenceMs(performance.now());
      const text = Number.isFinite(silence) ? `for ${ageText(silence)}` : "since this page opened";
      if (root.current.textContent !== text) root.current.textContent = text;
    },
    kDigitsHz,
    [],
  );
  return <span class="span" aria-hidden="true" ref={root} />;
}

export function SilenceBand() {
  const presence = session.presence.value;
  if (presence === "here") return null;
  return (
    <section class="no-base" role="alert" data-presence={presence} aria-label="no base">
      <p class="headline">
        <strong>NO BASE</strong> <Silence />
        <span class="meaning">
          {presence === "gone"
            ? "No stop goes out from this console. All that is shown is old."
            : "A stop still goes out, and may come late. All that is shown is old."}
        </span>
      </p>
      <ol class="remains" aria-label="what remains to be done">
        <li>
          <b>Race control by voice:</b> red or purple flag for car{" "}
          {session.hello.value?.car ?? "\u2013"}.
        </li>
        <li>
          <b>The car by itself:</b> where it has lost the base too, it slows down and then stops by
          the link-loss times of its file.
        </li>
        <li>
          <b>Another base:</b> the spare one, or this one started again. This page comes back by
          itself.
        </li>
      </ol>
    </section>
  );
}
