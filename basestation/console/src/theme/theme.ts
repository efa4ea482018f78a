/**
 * Which of the three grounds is used: dark for the garage, light for a tent, sun for the pit wall
 * at noon. What is drawn on a canvas asks here for the colours of the style sheet.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { repaint } from "../view/painting";

export const kThemes = ["dark", "light", "sun"] as const;
export type Theme = (typeof kThemes)[number];

const kStored = "pitwall.theme";

/** Storage may be refused (private window, policy): then the choice lasts as long as the page. */
function stored(): Theme {
  try {
    const name = localStorage.getItem(kStored);
    return kThemes.find((theme) => theme === name) ?? "dark";
  } catch {
    return "dark";
  }
}

export const theme = signal<Theme>(stored());

export interface Palette {
  ground: string;
  text: string;
  dim: string;
  line: string;
  stale: string;
  good: string;
  warning: string;
  bad: string;
  ego: string;
  asphalt: string;
  corner: string;
  rival: string;
  /** Of the cars of a base, in its order. */
  cars: string[];
  series: string[];
  stroke: number;
}

let palette: Palette | null = null;

export function colours(): Palette {
  if (palette) return palette;
  const style = getComputedStyle(document.documentElement);
  const get = (name: string) => style.getPropertyValue(`--${name}`).trim();
  palette = {
    ground: get("panel"),
    text: get("text"),
    dim: get("dim"),
    line: get("line"),
    stale: get("stale"),
    good: get("good"),
    warning: get("warning"),
    bad: get("bad"),
    ego: get("ego"),
    asphalt: get("asphalt"),
    corner: get("corner"),
    rival: get("rival"),
    cars: [1, 2, 3, 4].map((n) => get(`car-${n}`)),
    series: [1, 2, 3, 4, 5, 6].map((n) => get(`series-${n}`)),
    stroke: Number(get("stroke")) || 2,
  };
  return palette;
}

export function setTheme(to: Theme): void {
  document.documentElement.dataset.theme = to;
  palette = null;
  theme.value = to;
  try {
    localStorage.setItem(kStored, to);
  } catch {
    // The choice then lasts as long as the page.
  }
  repaint();
}

export const nextTheme = (): void =>
  setTheme(kThemes[(kThemes.indexOf(theme.value) + 1) % kThemes.length]);
