/**
 * Alarms: what is active, what was put on a shelf and what is suppressed, what came and went, and
 * how the rate stands against what a person can follow.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { isOperator, send } from "../../store/uplink";
import { acknowledge, acknowledgeAll, selectedAlarm } from "../../frame/keys";
import { shelving } from "../../frame/shelve";
import { AgeSince } from "../../view/age_since";
import { inOrder, needsEyes } from "../../view/alarm_order";
import { clockText } from "../../view/format";
import { TableHead } from "../../view/table_head";
import { inDisplayUnits } from "../../view/display_units";
import type { Alarm } from "../../wire/messages";
import { SettingsPanel } from "./settings";

/** In a flood only the first alarm of each cause and the high ones help. */
const kRateWanted = 1;

const kStates = {
  unack: "NEW",
  acked: "acknowledged",
  rtn_unack: "gone, not seen",
  latched: "latched",
} as const;

function ActiveRow({ alarm }: { alarm: Alarm }) {
  const selected = selectedAlarm.value === alarm.id;
  return (
    <li
      class="alarm"
      data-priority={alarm.priority}
      data-state={alarm.state}
      data-selected={selected}
      tabIndex={0}
      aria-label={`${alarm.priority} alarm, ${kStates[alarm.state] ?? alarm.state}: ${alarm.text}`}
      onFocus={() => (selectedAlarm.value = alarm.id)}
      onClick={() => (selectedAlarm.value = alarm.id)}
    >
      <i class="mark" aria-hidden="true" />
      <span class="priority">{alarm.priority}</span>
      <span class="text">
        {alarm.first_up && <b class="first-up">first</b>}
        {inDisplayUnits(alarm.text)}
        {alarm.count > 1 && <b> &times;{alarm.count}</b>}
      </span>
      <span class="state">{kStates[alarm.state] ?? alarm.state}</span>
      <AgeSince sinceMs={alarm.since_ms} />
      <span class="response">{alarm.response}</span>
      {isOperator.value && (
        <span class="actions">
          {needsEyes(alarm) && (
            <button type="button" onClick={() => acknowledge(alarm.id)}>
              Ack
            </button>
          )}
          {alarm.state === "latched" && (
            <button type="button" onClick={() => send({ type: "reset", alarm: alarm.id })}>
              Reset
            </button>
          )}
          {alarm.can_be_shelved !== false && (
            <button type="button" onClick={() => (shelving.value = alarm.id)}>
              Shelve
            </button>
          )}
        </span>
      )}
    </li>
  );
}

function Quiet({
  title,
  alarms,
  shelf,
}: {
  title: string;
  alarms: readonly Alarm[];
  shelf: boolean;
}) {
  return (
    <section class="panel" aria-label={title} tabIndex={0}>
      <h2>
        {title} <span class="sum">{alarms.length}</span>
      </h2>
      <ul class="quiet">
        {alarms.map((alarm) => (
          <li key={alarm.id}>
            <span class="text">{inDisplayUnits(alarm.text)}</span>
            <span class="reason">
              {alarm.reason ?? ""}
              {alarm.by ? ` (${alarm.by})` : ""}
            </span>
            {shelf && isOperator.value && (
              <button type="button" onClick={() => send({ type: "unshelve", alarm: alarm.id })}>
                Unshelve
              </button>
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}

function HistoryTable() {
  const events = session.alarmEvents.value.slice(-100).reverse();
  return (
    <section class="panel grows" aria-label="history" tabIndex={0}>
      <h2>History</h2>
      <table class="readings wide log">
        <TableHead names={["UTC", "alarm", "change", "by"]} />
        <tbody>
          {events.map((event, i) => (
            <tr key={`${event.time_ms} ${event.key} ${i}`}>
              <td>{clockText(session.clock.utcMs(event.time_ms))}</td>
              <th scope="row">{event.key}</th>
              <td class="change">
                {event.from} &rarr; {event.to}
              </td>
              <td>
                {event.by ?? ""} {event.reason ?? ""}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

export function AlarmsPage() {
  const alarms = session.alarms.value;
  const active = inOrder(alarms?.active ?? []);
  const flood = alarms?.kpi.flood ?? false;
  const shown = flood ? active.filter((a) => a.first_up || a.priority === "high") : active;
  const rate = alarms?.kpi.per_10_min ?? 0;
  return (
    <main class="page alarms-page">
      <section class="panel grows" aria-label="active alarms" tabIndex={0}>
        <h2>
          Active <span class="sum">{active.length}</span>
          {session.presence.value !== "here" && <b>as last received</b>}
          <span class="kpi" data-over={rate > kRateWanted}>
            {rate} in 10 min, wanted 1
          </span>
          {flood && <strong class="flood">FLOOD: first and high only</strong>}
          <span class="config">limits {session.hello.value?.alarm_config ?? ""}</span>
          {isOperator.value && active.some(needsEyes) && (
            <button type="button" onClick={acknowledgeAll}>
              Ack all shown <kbd>Shift A</kbd>
            </button>
          )}
        </h2>
        <ul class="active">
          {shown.map((alarm) => (
            <ActiveRow alarm={alarm} key={alarm.id} />
          ))}
        </ul>
        {active.length === 0 && <p class="empty">No alarm is active.</p>}
      </section>
      <div class="column">
        <Quiet title="Shelved" alarms={alarms?.shelved ?? []} shelf />
        <Quiet title="Suppressed" alarms={alarms?.suppressed ?? []} shelf={false} />
        <SettingsPanel />
        <HistoryTable />
      </div>
    </main>
  );
}
