/**
 * Which panels the primary page has and where: columns of panel names with their shares of the
 * page, as JSON that the base keeps. An unknown panel is left out, a broken layout refused.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";

export const kPanels = [
  "map",
  "speed",
  "tyres",
  "fuel",
  "watchdogs",
  "sensors",
  "gnss",
  "computer",
  "powertrain",
] as const;
export type PanelName = (typeof kPanels)[number];

export interface Column {
  share: number;
  panels: PanelName[];
}

export interface PrimaryLayout {
  version: 1;
  columns: Column[];
}

export const kDefaultLayout: PrimaryLayout = {
  version: 1,
  columns: [
    { share: 0.42, panels: ["map"] },
    { share: 0.26, panels: ["speed", "tyres", "fuel"] },
    { share: 0.32, panels: ["watchdogs", "sensors", "gnss", "computer", "powertrain"] },
  ],
};

export const primaryLayout = signal<PrimaryLayout>(kDefaultLayout);

const isPanel = (name: unknown): name is PanelName => kPanels.some((panel) => panel === name);

/** A layout out of untrusted JSON; null where it is none. */
export function readPrimaryLayout(json: unknown): PrimaryLayout | null {
  const columns = (json as { columns?: unknown } | null)?.columns;
  if (!Array.isArray(columns) || columns.length === 0 || columns.length > 4) return null;
  const read: Column[] = [];
  for (const column of columns as Partial<Column>[]) {
    const share = column?.share;
    if (typeof share !== "number" || !(share > 0.05 && share <= 1)) return null;
    if (!Array.isArray(column.panels)) return null;
    read.push({ share, panels: column.panels.filter(isPanel) });
  }
  return { version: 1, columns: read };
}

/** The layout with a panel moved one place; the same object where it cannot move that way. */
export function moved(layout: PrimaryLayout, panel: PanelName, key: string): PrimaryLayout {
  const columns = layout.columns.map((c) => ({ ...c, panels: [...c.panels] }));
  const from = columns.findIndex((c) => c.panels.includes(panel));
  if (from < 0) return layout;
  const at = columns[from].panels.indexOf(panel);
  const to = from + (key === "ArrowLeft" ? -1 : key === "ArrowRight" ? 1 : 0);
  const place = at + (key === "ArrowUp" ? -1 : key === "ArrowDown" ? 1 : 0);
  if (to !== from) {
    if (!columns[to]) return layout;
    columns[from].panels.splice(at, 1);
    columns[to].panels.splice(Math.min(at, columns[to].panels.length), 0, panel);
  } else {
    if (place === at || place < 0 || place >= columns[from].panels.length) return layout;
    columns[from].panels.splice(at, 1);
    columns[from].panels.splice(place, 0, panel);
  }
  return { version: 1, columns };
}
