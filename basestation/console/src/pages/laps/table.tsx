/**
 * The laps with their times, newest first: which one is looked at, and which one it is compared
 * with.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { clockText, kDash, lapTimeText, signedText } from "../../view/format";
import type { LapRow } from "../../wire/laps";
import { remarkOf } from "./comparison";

export function LapTable({ shown }: { shown: LapRow | null }) {
  const { laps } = session.shownCar.value;
  const table = laps.table.value;
  const reference = laps.referenceRow.value;
  const best = laps.row(table?.best ?? null);
  return (
    <aside class="lap-table" aria-label="laps">
      <div class="tools">
        <button
          type="button"
          aria-pressed={laps.shown.value === null}
          onClick={() => (laps.shown.value = null)}
        >
          Lap of the moment
        </button>
        <button
          type="button"
          aria-pressed={laps.reference.value === null}
          onClick={() => (laps.reference.value = null)}
        >
          Against the best
        </button>
      </div>
      <div class="rows">
        <table>
          <thead>
            <tr>
              <th>lap</th>
              <th>counted</th>
              <th>began</th>
              <th>time</th>
              <th>to best</th>
              <th>reference</th>
            </tr>
          </thead>
          <tbody>
            {[...(table?.laps ?? [])].reverse().map((row) => (
              <tr
                key={row.id}
                data-shown={row.id === shown?.id}
                data-reference={row.id === reference?.id}
              >
                <td>
                  <button
                    type="button"
                    aria-label={`show lap ${row.id}`}
                    aria-pressed={row.id === shown?.id}
                    onClick={() => (laps.shown.value = row.id)}
                  >
                    {row.id}
                  </button>
                </td>
                <td>{row.number ?? kDash}</td>
                <td>{clockText(session.clock.utcMs(row.begin_ms))}</td>
                <td class={row === best ? "time best" : "time"}>
                  {row.time_s === null ? (
                    <span class="remark">{remarkOf(row)}</span>
                  ) : (
                    <>
                      {lapTimeText(row.time_s, 3)}
                      <span class="remark">{remarkOf(row)}</span>
                    </>
                  )}
                </td>
                <td>
                  {row.time_s === null || best?.time_s == null
                    ? kDash
                    : signedText(row.time_s - best.time_s, 3)}
                </td>
                <td>
                  <button
                    type="button"
                    aria-label={`compare with lap ${row.id}`}
                    aria-pressed={row.id === reference?.id}
                    onClick={() => (laps.reference.value = row.id)}
                  >
                    ref
                  </button>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
        {!table?.laps.length && <p class="empty">No lap yet.</p>}
      </div>
    </aside>
  );
}
