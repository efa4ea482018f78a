/**
 * The audit log: who did what when, and what came of it; saved as a file of tab-separated lines.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { clockText } from "../../view/format";
import { TableHead } from "../../view/table_head";

const kShown = 100;

/** One line each, UTC first; tabs and line ends of the text become spaces. */
export function auditText(): string {
  const clean = (text: unknown) => String(text).replaceAll(/[\t\r\n]/g, " ");
  const lines = session.audit.value.map((line) =>
    [new Date(session.clock.utcMs(line.time_ms)).toISOString(), line.who, line.what, line.result]
      .map(clean)
      .join("\t"),
  );
  return ["utc\twho\twhat\tresult", ...lines, ""].join("\n");
}

function save(): void {
  const url = URL.createObjectURL(new Blob([auditText()], { type: "text/tab-separated-values" }));
  const link = document.createElement("a");
  link.href = url;
  link.download = "pitwall_audit.tsv";
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
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
              <td>{line.what}</td>
              <td>{line.result}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
