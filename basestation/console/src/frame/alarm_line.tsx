/**
 * The bottom line: the newest unacknowledged alarm of the highest priority, with what to do about
 * it. A high one is spoken at once, others when the screen reader has a pause.
 */
// SPDX-License-Identifier: Apache-2.0
import { useEffect } from "preact/hooks";
import * as session from "../store/session";
import { inOrder, loudest, needsEyes } from "../view/alarm_order";
import { acknowledge } from "./keys";
import { isOperator } from "../store/uplink";
import { showPage } from "./pages";
import { SoundButton } from "./sound_button";
import { AgeSince } from "../view/age_since";
import { inDisplayUnits } from "../view/display_units";

const kErrorShownMs = 20_000;

/** What the base last refused this console, for a while; the audit log keeps it. */
function Refused() {
  const error = session.lastError.value;
  useEffect(() => {
    if (!error) return;
    const timer = setTimeout(() => {
      if (session.lastError.value === error) session.lastError.value = null;
    }, kErrorShownMs);
    return () => clearTimeout(timer);
  }, [error]);
  return error ? (
    <span class="refused">
      refused: {error.what} ({error.place})
    </span>
  ) : null;
}

/** Without a base nobody knows which alarms there are. */
function Unknown() {
  return (
    <div class="alarm-line" data-priority="none" role="status">
      <span class="text">alarms not known: no base</span>
    </div>
  );
}

export function AlarmLine() {
  if (session.presence.value !== "here") return <Unknown />;
  const active = session.alarms.value?.active ?? [];
  const first = loudest(active);
  const others = inOrder(active).filter(needsEyes).length - 1;
  if (!first) {
    return (
      <div class="alarm-line" data-priority="none" role="status" aria-live="polite">
        <span class="text">
          {active.length > 0 ? `${active.length} alarms, all acknowledged` : "no alarms"}
        </span>
        <Refused />
        <SoundButton />
      </div>
    );
  }
  return (
    <div
      class="alarm-line"
      data-priority={first.priority}
      data-state={first.state}
      role="status"
      aria-live={first.priority === "high" ? "assertive" : "polite"}
    >
      <i class="mark" aria-hidden="true" />
      <strong>{first.priority.toUpperCase()}</strong>
      <span class="text">
        {inDisplayUnits(first.text)}
        {first.count > 1 ? ` \u00d7${first.count}` : ""}
      </span>
      <span class="response">{first.response}</span>
      <AgeSince sinceMs={first.since_ms} />
      <Refused />
      <SoundButton />
      {others > 0 && (
        <button type="button" onClick={() => showPage("alarms")}>
          +{others} more
        </button>
      )}
      {isOperator.value && (
        <button type="button" onClick={() => acknowledge(first.id)}>
          Ack <kbd>A</kbd>
        </button>
      )}
    </div>
  );
}
