/**
 * Lines of a table as a file of tab-separated values that the browser saves.
 */
// SPDX-License-Identifier: Apache-2.0

type Cells = readonly (string | number)[];

/** The names first; tabs and line ends inside a cell become spaces. */
export function tsvText(names: readonly string[], lines: readonly Cells[]): string {
  const text = (cells: Cells) =>
    cells.map((cell) => String(cell).replaceAll(/[\t\r\n]/g, " ")).join("\t");
  return [text(names), ...lines.map(text), ""].join("\n");
}

export function saveTsv(file: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: "text/tab-separated-values" }));
  const link = document.createElement("a");
  link.href = url;
  link.download = file;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
