/**
 * The radio's budget: what the base may put up, against what it puts up now; lowered and raised by
 * who holds the authority, with what that leaves.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import * as session from "../../store/session";
import { isHolder, send } from "../../store/uplink";
import { Review } from "../../view/entry";
import { Line } from "../../view/value";

export function BudgetPanel() {
  const settings = session.settings.value;
  const [wanted, setWanted] = useState<number | null>(null);
  if (!settings || typeof settings.up_kbit_s !== "number") return null;
  const now = settings.up_kbit_s;
  const at = wanted ?? now;
  return (
    <section class="panel" aria-label="budget" tabIndex={0}>
      <h2>
        Budget up <span class="sum">{now} kbit/s each radio</span>
      </h2>
      <div class="lines">
        <Line label="load up now" path="link.up_kbit_s" decimals={1} />
      </div>
      {isHolder.value && (
        <>
          <label class="slide">
            <input
              type="range"
              aria-label="kbit/s up each radio"
              min={settings.up_least_kbit_s}
              max={settings.up_most_kbit_s}
              step={1}
              value={at}
              onInput={(e) => setWanted(Number(e.currentTarget.value))}
            />
            {at} kbit/s
          </label>
          <Review
            changes={at === now ? [] : [`up, each radio: ${now} \u2192 ${at} kbit/s`]}
            onApply={(reason) => {
              send({ type: "edit_budget", up_kbit_s: at, reason });
              setWanted(null);
            }}
          />
        </>
      )}
    </section>
  );
}
