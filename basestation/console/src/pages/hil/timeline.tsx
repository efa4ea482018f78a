/**
 * The plan of the run on a time axis, with how far it is and what has happened.
 */
// SPDX-License-Identifier: Apache-2.0
import type { BenchEvent, BenchPlan } from "../../wire/bench";
import { axisOf, happened, lanesOf, percent, progressOf } from "./lanes";

const kLeastWidth = 0.6;

export function TimelinePanel(props: {
  plan: BenchPlan;
  nowS: number;
  events: readonly BenchEvent[];
}) {
  const { plan, nowS, events } = props;
  const at = (s: number) => `${percent(s, plan.duration_s).toFixed(2)}%`;
  const occurred = happened(events);
  return (
    <section class="panel run-timeline" aria-label="timeline" tabIndex={0}>
      <h2>
        Timeline <span class="sum">scenario time, s</span>
      </h2>
      <div class="axis" aria-hidden="true">
        {axisOf(plan.duration_s).map((s) => (
          <span style={{ left: at(s) }} key={s}>
            {s}
          </span>
        ))}
      </div>
      <ol class="lanes">
        {lanesOf(plan).map((lane, i) => {
          const width = percent(lane.to, plan.duration_s) - percent(lane.from, plan.duration_s);
          return (
            <li data-kind={lane.kind} data-progress={progressOf(lane, nowS)} key={i}>
              <span class="what">
                {lane.kind} {lane.what}
                <span class="sr-only">
                  , from {lane.from} to {lane.to} s, {progressOf(lane, nowS)}
                </span>
              </span>
              <span class="track">
                <i
                  class="span"
                  style={{ left: at(lane.from), width: `${Math.max(width, kLeastWidth)}%` }}
                />
                <i class="now" style={{ left: at(nowS) }} />
              </span>
            </li>
          );
        })}
        <li data-kind="events">
          <span class="what">events of the run</span>
          <span class="track">
            {occurred.map((event, i) => (
              <i
                class="event"
                data-event={event.kind}
                style={{ left: at(event.t_s) }}
                title={`${event.t_s.toFixed(2)} s ${event.kind} ${event.text}`}
                key={i}
              />
            ))}
            <i class="now" style={{ left: at(nowS) }} />
          </span>
        </li>
      </ol>
      <ul class="event-list" aria-label="newest events">
        {[...events]
          .slice(-6)
          .reverse()
          .map((event, i) => (
            <li key={i}>
              <b>{event.t_s.toFixed(2)}</b> {event.kind.replace("_", " ")} {event.text}
            </li>
          ))}
      </ul>
    </section>
  );
}
