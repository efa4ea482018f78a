/**
 * The pages by their number key, and which one is shown; the address keeps it, so that a link and
 * the browser's own back key work.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";

export const kPages = [
  { key: 1, name: "primary", title: "Primary" },
  { key: 2, name: "plots", title: "Plots" },
  { key: 3, name: "telemetry", title: "Telemetry" },
  { key: 4, name: "link", title: "Link" },
  { key: 5, name: "commands", title: "Commands" },
  { key: 6, name: "alarms", title: "Alarms" },
  { key: 7, name: "race", title: "Race" },
  { key: 8, name: "hil", title: "HIL" },
  { key: 9, name: "replay", title: "Pre-run" },
  { key: 0, name: "events", title: "Events" },
] as const;

export type PageName = (typeof kPages)[number]["name"];

const named = (): PageName =>
  kPages.find((page) => `#/${page.name}` === location.hash)?.name ?? "primary";

export const page = signal<PageName>(named());

export function showPage(name: PageName): void {
  if (location.hash !== `#/${name}`) location.hash = `#/${name}`;
  page.value = name;
}

window.addEventListener("hashchange", () => (page.value = named()));
