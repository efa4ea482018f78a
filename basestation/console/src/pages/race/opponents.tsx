/**
 * The rivals that the car tracks, nearest along the road first: where each is, how fast, since when
 * it has not been detected and how surely its place is known.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import { isGone, kRivals } from "../../map/scene";
import * as session from "../../store/session";
import { kDigitsHz, usePainter } from "../../view/painting";
import { speedUnit } from "../../view/speed_unit";
import { TableHead } from "../../view/table_head";
import { Value } from "../../view/value";

const kColumns = [
  ["station", 0],
  ["offset", 1],
  ["speed", 0],
  ["age", 1],
  ["position_sigma", 1],
] as const;

function Opponent({ group }: { group: string }) {
  const row = useRef<HTMLTableRowElement>(null);
  const store = session.fields.value;
  usePainter(
    () => {
      if (row.current) row.current.style.visibility = isGone(store, group) ? "hidden" : "";
    },
    kDigitsHz,
    [store, group],
  );
  return (
    <tr ref={row}>
      <th scope="row">
        <Value path={`${group}.identity`} />
      </th>
      {kColumns.map(([name, decimals]) => (
        <td key={name}>
          <Value path={`${group}.${name}`} decimals={decimals} unit={false} />
        </td>
      ))}
    </tr>
  );
}

export function OpponentPanel() {
  const names = ["#", "station m", "offset m", speedUnit.value.name, "seen s ago", "\u03c3 m"];
  return (
    <section class="panel" aria-label="tracked rivals" tabIndex={0}>
      <h2>Tracked rivals</h2>
      <table class="readings wide opponents">
        <TableHead names={names} />
        <tbody>
          {Array.from({ length: kRivals }, (_, i) => `opponent_${i + 1}`).map((group) => (
            <Opponent key={group} group={group} />
          ))}
        </tbody>
      </table>
    </section>
  );
}
