/**
 * The check list before a run: each item with its value and its age, go or no-go as the base has
 * judged it. A list that is old says so and is no go, whatever stood in it.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import * as session from "../../store/session";
import { inDisplayUnits } from "../../view/display_units";
import { ageText } from "../../view/format";
import { kDigitsHz, usePainter } from "../../view/painting";
import { isSilent, liveMs } from "../../view/timeline";
import type { Check } from "../../wire/pit";
import { verdictOf } from "./verdict";
import type { Verdict } from "./verdict";

const kWords: Record<Verdict, string> = { go: "GO", "no-go": "NO-GO", unknown: "NOT KNOWN" };

function CheckRow({ check, old, sinceMs }: { check: Check; old: boolean; sinceMs: number }) {
  const verdict: Verdict = old ? "unknown" : check.go ? "go" : "no-go";
  return (
    <li class="gate check" data-ok={old ? undefined : check.go} data-verdict={verdict}>
      <i class="mark" aria-hidden="true" />
      <b class="verdict">{kWords[verdict]}</b>
      <span class="name">{check.name}</span>
      <span class="text">{inDisplayUnits(check.text)}</span>
      <span class="age">{ageText(check.age_ms + sinceMs)}</span>
    </li>
  );
}

export function ChecklistPanel() {
  const list = session.checklist.value;
  const [nowMs, setNow] = useState(NaN);
  const [silent, setSilent] = useState(true);
  usePainter(
    () => {
      setNow(liveMs());
      setSilent(isSilent());
    },
    kDigitsHz,
    [],
  );
  const verdict = verdictOf(list, nowMs, silent);
  const open = list?.checks.filter((check) => !check.go).length ?? 0;
  return (
    <section class="panel grows checklist" aria-label="check list before a run" tabIndex={0}>
      <h2>
        Before a run
        <output class="count" data-verdict={verdict} aria-label="go or no-go">
          {kWords[verdict]}
        </output>
        {verdict === "no-go" && <span class="sum">{open} open</span>}
      </h2>
      {list === null && <p class="empty">The base has not judged anything yet.</p>}
      <ol class="checks">
        {list?.checks.map((check) => (
          <CheckRow
            check={check}
            old={verdict === "unknown"}
            sinceMs={Math.max(0, nowMs - list.time_ms) || 0}
            key={check.name}
          />
        ))}
      </ol>
    </section>
  );
}
