/**
 * Moments of a replay to jump to: alarms that came, what people did, what the car said, as far as
 * the file has been played.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { durationText } from "../../view/format";
import { seekFile } from "../../view/transport";

const kMost = 200;
/** A jump lands before the moment, so that one sees it come. */
const kBeforeMs = 3000;

interface Moment {
  atMs: number;
  kind: string;
  text: string;
}

/** Newest first. */
function moments(): Moment[] {
  const all: Moment[] = [
    ...session.alarmEvents.value
      .filter((event) => event.to === "unack")
      .map((event) => ({ atMs: event.time_ms, kind: "alarm", text: event.key })),
    ...session.audit.value.map((line) => ({
      atMs: line.time_ms,
      kind: "people",
      text: `${line.who}: ${line.what}`,
    })),
    ...session.carEvents.value.map((event) => ({
      atMs: event.time_ms,
      kind: "car",
      text: event.text,
    })),
  ];
  return all.sort((a, b) => b.atMs - a.atMs).slice(0, kMost);
}

export function MomentsPanel() {
  const playback = session.playback.value;
  const list = moments();
  return (
    <section class="panel grows moments" aria-label="moments" tabIndex={0}>
      <h2>
        Moments <span class="sum">{list.length} up to here</span>
      </h2>
      {list.length === 0 && <p class="empty">Nothing happened up to here; play on.</p>}
      <ol>
        {list.map((moment, i) => (
          <li key={`${moment.atMs} ${moment.kind} ${i}`}>
            <button type="button" onClick={() => seekFile(moment.atMs - kBeforeMs)}>
              {durationText(moment.atMs - (playback?.begin_ms ?? moment.atMs))}
            </button>
            <span class="kind">{moment.kind}</span>
            <span class="text">{moment.text}</span>
          </li>
        ))}
      </ol>
    </section>
  );
}
