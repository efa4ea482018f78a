/**
 * Limits and alarms, changed by who holds the authority: chosen, filled in, reviewed, held. The
 * base says what it refuses, and counts a revision for what it takes.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import * as session from "../../store/session";
import { isHolder, send } from "../../store/uplink";
import { kPriorities } from "../../view/alarm_order";
import { NumberEntry, Review } from "../../view/entry";
import { kDash, unitText } from "../../view/format";
import type { AlarmSetting, FieldInfo, Limits } from "../../wire/messages";

const kBounds = ["warning_low", "warning_high", "bad_low", "bad_high"] as const;
const kNumbers = ["limit", "deadband", "on_s", "off_s"] as const;
const kMeanings = ["good", "warning", "bad"] as const;
const kFieldMark = "field ";

type Edited = Record<string, string>;

const shown = (value: unknown): string =>
  value === null || value === undefined ? "" : String(value);
const wordFor = (key: string): string =>
  ({ on_s: "on after", off_s: "off after" })[key] ?? key.replace("_", " ");

/** Lines of what differs from what is in force. */
export function changes(before: object, edited: Edited): string[] {
  const known = before as Record<string, unknown>;
  return Object.keys(edited)
    .filter((key) => edited[key] !== shown(known[key]))
    .map((key) => `${wordFor(key)}: ${shown(known[key]) || kDash} \u2192 ${edited[key] || kDash}`);
}

/** Of a value of an enumeration, by the sets in force. */
export function meaningOf(limits: Limits, value: number): (typeof kMeanings)[number] {
  if (limits.bad_values?.includes(value)) return "bad";
  return limits.warning_values?.includes(value) ? "warning" : "good";
}

const numberOf = (text: string): number | null => (text === "" ? null : Number(text));

function AlarmEditor({ alarm }: { alarm: AlarmSetting }) {
  const [edited, setEdited] = useState<Edited>({});
  const at = (key: string) => edited[key] ?? shown((alarm as unknown as Edited)[key]);
  const put = (key: string, text: string) => setEdited({ ...edited, [key]: text });
  const apply = (reason: string) => {
    const numbers = Object.fromEntries(kNumbers.map((key) => [key, numberOf(at(key))]));
    send({ type: "edit_alarm", key: alarm.key, priority: at("priority"), ...numbers, reason });
    setEdited({});
  };
  return (
    <>
      <p>
        {alarm.text}: {alarm.path} {alarm.side} {alarm.limit} {unitText(alarm.unit)}
        {alarm.by ? ` (changed by ${alarm.by})` : ""}
      </p>
      <div class="entry">
        {kNumbers.map((key) => (
          <NumberEntry
            key={key}
            label={wordFor(key)}
            unit={key.endsWith("_s") ? "s" : unitText(alarm.unit)}
            text={at(key)}
            onText={(text) => put(key, text)}
            required
          />
        ))}
        <label>
          priority
          <select value={at("priority")} onChange={(e) => put("priority", e.currentTarget.value)}>
            {kPriorities.map((priority) => (
              <option key={priority}>{priority}</option>
            ))}
          </select>
        </label>
      </div>
      <Review changes={changes(alarm, edited)} onApply={apply} />
    </>
  );
}

/** What each value of an enumeration means. */
function ValueSetEditor({ info }: { info: FieldInfo }) {
  const [edited, setEdited] = useState<Edited>({});
  const names = info.labels ?? [];
  const before = Object.fromEntries(
    names.map((name, value) => [name, meaningOf(info.limits ?? {}, value)]),
  );
  const at = (name: string) => edited[name] ?? before[name];
  const among = (meaning: string) =>
    names.map((name, value) => (at(name) === meaning ? value : -1)).filter((v) => v >= 0);
  const apply = (reason: string) => {
    const bounds = Object.fromEntries(kBounds.map((key) => [key, info.limits?.[key] ?? null]));
    const sets = { warning_values: among("warning"), bad_values: among("bad") };
    send({ type: "edit_limit", field: info.path, ...bounds, ...sets, reason });
    setEdited({});
  };
  return (
    <>
      <div class="entry">
        {names.map((name) => (
          <label key={name}>
            {name}
            <select
              value={at(name)}
              onChange={(e) => setEdited({ ...edited, [name]: e.currentTarget.value })}
            >
              {kMeanings.map((meaning) => (
                <option key={meaning}>{meaning}</option>
              ))}
            </select>
          </label>
        ))}
      </div>
      <Review changes={changes(before, edited)} onApply={apply} />
    </>
  );
}

function LimitEditor({ info }: { info: FieldInfo }) {
  const limits = info.limits ?? {};
  const [edited, setEdited] = useState<Edited>({});
  const at = (key: (typeof kBounds)[number]) => edited[key] ?? shown(limits[key]);
  const apply = (reason: string) => {
    const bounds = Object.fromEntries(kBounds.map((key) => [key, numberOf(at(key))]));
    send({ type: "edit_limit", field: info.path, ...bounds, reason });
    setEdited({});
  };
  return (
    <>
      <div class="entry">
        {kBounds.map((key) => (
          <NumberEntry
            key={key}
            label={wordFor(key)}
            unit={unitText(info.unit)}
            text={at(key)}
            onText={(text) => setEdited({ ...edited, [key]: text })}
          />
        ))}
      </div>
      <Review changes={changes(limits, edited)} onApply={apply} />
    </>
  );
}

export function SettingsPanel() {
  const settings = session.settings.value;
  const [chosen, setChosen] = useState("");
  const alarms = settings?.alarms ?? [];
  const alarm = alarms.find((a) => a.key === chosen);
  const field = session.fields.value.info.find((f) => kFieldMark + f.path === chosen);
  // Bits have no single value that could be good or bad.
  const judged = session.fields.value.info.filter((f) => f.unit !== "bits");
  return (
    <section class="panel settings" aria-label="limits and alarms" tabIndex={0}>
      <h2>
        Limits <span class="sum">revision {settings?.revision ?? kDash}</span>
        {settings && !settings.kept && <span class="sum">not kept: no file</span>}
      </h2>
      {settings?.problem && (
        <p class="sum" role="status">
          {settings.problem}
        </p>
      )}
      {!isHolder.value && <p class="empty">Who holds the authority changes them here.</p>}
      {isHolder.value && (
        <select
          aria-label="alarm or field"
          value={chosen}
          onChange={(e) => setChosen(e.currentTarget.value)}
        >
          <option value="">choose an alarm or a field</option>
          <optgroup label="alarms">
            {alarms.map((a) => (
              <option value={a.key} key={a.key}>
                {a.key}
              </option>
            ))}
          </optgroup>
          <optgroup label="fields">
            {judged.map((f) => (
              <option value={kFieldMark + f.path} key={f.path}>
                {f.path}
              </option>
            ))}
          </optgroup>
        </select>
      )}
      {isHolder.value && alarm && <AlarmEditor alarm={alarm} key={alarm.key} />}
      {isHolder.value && field && !field.labels?.length && (
        <LimitEditor info={field} key={field.path} />
      )}
      {isHolder.value && field && !!field.labels?.length && (
        <ValueSetEditor info={field} key={field.path} />
      )}
    </section>
  );
}
