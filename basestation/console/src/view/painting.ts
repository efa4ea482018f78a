/**
 * One requestAnimationFrame loop draws everything. A painter is a plain function with a highest
 * rate of its own: digits 4 a second, gauges 10, plots 20, the map 30, what is critical each frame.
 * What is critical is always painted; of the rest as much as fits into a frame, the most overdue
 * first. So many charts get slower one by one, and no frame holds up an alarm or a key.
 * Frames of the base are only stored when they come; a tab that sleeps has nothing to catch up.
 */
// SPDX-License-Identifier: Apache-2.0
import { useEffect } from "preact/hooks";
import { beginFrame } from "./timeline";

export const kDigitsHz = 4;
export const kGaugesHz = 10;
export const kPlotsHz = 20;
export const kMapHz = 30;
export const kEachFrame = Infinity;

interface Painter {
  paint: () => void;
  periodMs: number;
  lastMs: number;
}

const kLongAgoMs = -1e12;
/** Of a frame of 16.7 ms; the browser needs the rest to show what was painted. */
const kBudgetMs = 10;

const painters = new Set<Painter>();
let lastFrameMs = 0;
/** How long the last frame's painting took, for the display's own latency figure. */
export let lastPaintMs = 0;

/** Paints at once and then at most `hz` times a second, until the returned function is called. */
export function addPainter(paint: () => void, hz: number): () => void {
  const painter = { paint, periodMs: hz === kEachFrame ? 0 : 1000 / hz, lastMs: kLongAgoMs };
  painters.add(painter);
  return () => painters.delete(painter);
}

/** Makes every painter due, after a jump in time or a change of theme. */
export function repaint(): void {
  for (const painter of painters) painter.lastMs = kLongAgoMs;
}

/** Those whose time has come: the critical ones, then by how many of their periods they wait. */
function dueOf(all: Iterable<Painter>, nowMs: number): Painter[] {
  const critical = ({ periodMs }: Painter) => Number(periodMs === 0);
  const waits = ({ lastMs, periodMs }: Painter) => (nowMs - lastMs) / Math.max(periodMs, 1);
  return [...all]
    .filter(({ lastMs, periodMs }) => nowMs - lastMs >= periodMs - 4)
    .sort((a, b) => critical(b) - critical(a) || waits(b) - waits(a));
}

function frame(nowMs: number): void {
  requestAnimationFrame(frame);
  const begun = performance.now();
  beginFrame(begun, Math.min(nowMs - lastFrameMs, 1000));
  lastFrameMs = nowMs;
  for (const painter of dueOf(painters, nowMs)) {
    if (painter.periodMs > 0 && performance.now() - begun > kBudgetMs) break;
    painter.lastMs = nowMs;
    painter.paint();
  }
  lastPaintMs = performance.now() - begun;
}

export function startPainting(): void {
  requestAnimationFrame(frame);
}

/** A painter that lives as long as its component. */
export function usePainter(paint: () => void, hz: number, inputs: readonly unknown[]): void {
  useEffect(() => addPainter(paint, hz), inputs as unknown[]);
}
