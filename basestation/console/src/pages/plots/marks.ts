/**
 * Marks on the time axis of a chart: alarms that came, commands that were sent, and hatching over
 * the time in which nothing was known of a line.
 */
// SPDX-License-Identifier: Apache-2.0
import type uPlot from "uplot";
import * as session from "../../store/session";
import { colours } from "../../theme/theme";

const kHatchPx = 8;
const kLetterPx = 14;

interface Span {
  from: number;
  to: number;
}

/** The stretches of a plot in which its first line has no value. */
export function unknownSpans(timeS: ArrayLike<number>, value: ArrayLike<unknown>): Span[] {
  const spans: Span[] = [];
  let from = NaN;
  for (let i = 0; i < timeS.length; ++i) {
    const unknown = value[i] === null || value[i] === undefined;
    if (unknown && Number.isNaN(from)) from = timeS[i];
    if (!unknown && !Number.isNaN(from)) {
      spans.push({ from, to: timeS[i] });
      from = NaN;
    }
  }
  if (!Number.isNaN(from)) spans.push({ from, to: timeS[timeS.length - 1] });
  return spans;
}

function hatch(pen: CanvasRenderingContext2D, x0: number, x1: number, y: number, h: number): void {
  pen.save();
  pen.beginPath();
  pen.rect(x0, y, x1 - x0, h);
  pen.clip();
  pen.beginPath();
  for (let x = x0 - h; x < x1; x += kHatchPx) {
    pen.moveTo(x, y + h);
    pen.lineTo(x + h, y);
  }
  pen.stroke();
  pen.restore();
}

function moments(): { atS: number; colour: string; letter: string }[] {
  const palette = colours();
  return [
    ...session.alarmEvents.value
      .filter((event) => event.to === "unack")
      .map((event) => ({ atS: event.time_ms / 1000, colour: palette.dim, letter: "A" })),
    ...session.ladder.value
      .filter((step) => step.times_ms?.sent !== undefined)
      .map((step) => ({ atS: step.times_ms!.sent / 1000, colour: palette.text, letter: "C" })),
  ];
}

export function drawMarks(plot: uPlot): void {
  const { left, top, width, height } = plot.bbox;
  const pen = plot.ctx;
  const { min, max } = plot.scales.x;
  if (min == null || max == null) return;
  const x = (atS: number) => plot.valToPos(Math.min(Math.max(atS, min), max), "x", true);
  pen.save();
  pen.setLineDash([]);
  pen.strokeStyle = colours().line;
  pen.lineWidth = 1;
  for (const span of unknownSpans(plot.data[0], plot.data[1] ?? [])) {
    if (span.to > min) hatch(pen, x(span.from), x(span.to), top, height);
  }
  pen.font = `${kLetterPx * devicePixelRatio}px Barlow, sans-serif`;
  for (const { atS, colour, letter } of moments()) {
    if (atS < min || atS > max) continue;
    pen.strokeStyle = colour;
    pen.fillStyle = colour;
    pen.beginPath();
    pen.moveTo(x(atS), top);
    pen.lineTo(x(atS), top + height);
    pen.stroke();
    if (x(atS) < left + width - kLetterPx)
      pen.fillText(letter, x(atS) + 3, top + kLetterPx * devicePixelRatio);
  }
  pen.restore();
}
