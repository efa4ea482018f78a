/**
 * The audit log: who did what when, and what came of it; saved as a file of tab-separated lines.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { clockText } from "../../view/format";
import { saveTsv, tsvText } from "../../view/save_lines";
import { TableHead } from "../../view/table_head";
import { inDisplayUnits } from "../../view/display_units";

const kShown = 100;

function save(): void {
  const lines = session.audit.value.map(({ time_ms, who, what, result }) => [
    new Date(session.clock.utcMs(time_ms)).toISOString(),
    who,
    what,
    result,
  ]);
  saveTsv("pitwall_audit.tsv", tsvText(["utc", "who", "what", "result"], lines));
}

export function AuditPanel() {
  const lines = session.audit.value.slice(-kShown).reverse();
  return (
    <section class="panel grows" aria-label="audit" tabIndex={0}>
      <h2>
        Audit <span class="sum">{session.audit.value.length}</span>
        <button type="button" onClick={save} disabled={lines.length === 0}>
          Save
        </button>
      </h2>
      <table class="readings wide log">
        <TableHead names={["UTC", "who", "what", "result"]} />
        <tbody>
          {lines.map((line, i) => (
            <tr key={`${line.time_ms} ${i}`}>
              <td>{clockText(session.clock.utcMs(line.time_ms))}</td>
              <th scope="row">{line.who}</th>
              <td>{inDisplayUnits(line.what)}</td>
              <td>{inDisplayUnits(line.result)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
