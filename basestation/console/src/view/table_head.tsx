/**
 * The head of a table of readings: one name a column; a column without a name has a spoken one.
 */
// SPDX-License-Identifier: Apache-2.0

export type ColumnName = string | { spoken: string };

export function TableHead({ names }: { names: readonly ColumnName[] }) {
  return (
    <thead>
      <tr>
        {names.map((name) =>
          typeof name === "string" ? (
            <th scope="col" key={name}>
              {name}
            </th>
          ) : (
            <th scope="col" key={name.spoken} aria-label={name.spoken} />
          ),
        )}
      </tr>
    </thead>
  );
}
