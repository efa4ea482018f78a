/**
 * Both receivers side by side, so that a difference is seen, and whether the car uses what they
 * say.
 */
// SPDX-License-Identifier: Apache-2.0
import { TableHead } from "../../view/table_head";
import { Value } from "../../view/value";
import type { ValueProps } from "../../view/value";
import { solutionStatus, solutionType } from "../../view/novatel_names";

type Row = readonly [label: string, field: string, props?: Partial<ValueProps>];

const kRows: readonly Row[] = [
  ["solution", "type", { text: solutionType }],
  ["status", "status", { text: solutionStatus }],
  ["satellites", "satellites"],
  ["\u03c3 position", "sigma", { decimals: 3 }],
  ["\u03c3 heading", "heading_sigma", { scale: 57.29578, decimals: 2, unit: "\u00b0" }],
  ["corr. age", "differential_age", { decimals: 1 }],
  ["position used", "position_verdict"],
];

export function GnssPanel() {
  return (
    <table class="readings">
      <TableHead names={[{ spoken: "figure" }, "unit 0", "unit 1"]} />
      <tbody>
        {kRows.map(([label, field, props]) => (
          <tr key={field}>
            <th scope="row">{label}</th>
            <td>
              <Value path={`gnss0.${field}`} {...props} />
            </td>
            <td>
              <Value path={`gnss1.${field}`} {...props} />
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
