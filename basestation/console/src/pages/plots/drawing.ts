/**
 * How a chart is drawn: axes of time before the moment shown or of metres along the lap, one line a
 * series, and what lies behind the lines.
 */
// SPDX-License-Identifier: Apache-2.0
import type uPlot from "uplot";
import * as session from "../../store/session";
import { colours } from "../../theme/theme";
import { decimalsOf, fixed } from "../../view/format";
import { shownMs } from "../../view/timeline";
import type { PlotAxis } from "./layout";
import { axisUnits, compared } from "./lines";
import type { Line } from "./lines";
import { drawMarks } from "./marks";

const kSync = "plots";
const kDashes = [[], [8, 4], [2, 3], [8, 3, 2, 3], [12, 6], [4, 6]];
const kOtherDash = [1, 4];
const kLabelPx = 14;
const kFont = `${kLabelPx}px Barlow, sans-serif`;

/** Ticks at whole steps before the moment shown, so that they stand still while the data runs. */
function backFrom(max: number, min: number, step: number): number[] {
  const splits: number[] = [];
  for (let at = max; at >= min; at -= step) splits.unshift(at);
  return splits;
}

function agoText(atS: number): string {
  const ago = atS - shownMs() / 1000;
  return Math.abs(ago) < 0.05 ? "0" : `\u2212${Math.abs(ago).toFixed(Math.abs(ago) < 10 ? 1 : 0)}`;
}

/** Of time or of distance, and of values in a unit. */
export function axesOf(axis: PlotAxis, unit: string): uPlot.Axis[] {
  const { dim, line } = colours();
  const looks = {
    stroke: dim,
    font: kFont,
    grid: { stroke: line, width: 1 },
    ticks: { stroke: line, width: 1, size: 4 },
  };
  const along: uPlot.Axis =
    axis === "time"
      ? {
          splits: (_, __, min, max, step) => backFrom(max, min, step),
          values: (_, splits) => splits.map((s) => agoText(s)),
        }
      : { values: (_, splits) => splits.map((m) => `${fixed(m, 0)} m`) };
  return [
    { ...looks, size: 28, space: 80, ...along },
    {
      ...looks,
      label: unit || undefined,
      labelFont: kFont,
      labelSize: 18,
      labelGap: 0,
      size: 54,
      space: 34,
      values: (_, splits, __, ___, step) => splits.map((v) => fixed(v, decimalsOf(step))),
    },
  ];
}

/** The corners of the track as bands with their names. */
export function drawCorners(plot: uPlot): void {
  const { top, height } = plot.bbox;
  const pen = plot.ctx;
  const track = session.track.value;
  if (!track) return;
  const x = (m: number) => plot.valToPos(m, "x", true);
  pen.save();
  pen.font = `${kLabelPx * devicePixelRatio}px Barlow, sans-serif`;
  pen.textAlign = "left";
  pen.textBaseline = "top";
  for (const { name, from_s, to_s } of track.corners) {
    const parts =
      from_s <= to_s
        ? [[from_s, to_s]]
        : [
            [from_s, track.length_m],
            [0, to_s],
          ];
    for (const [from, to] of parts) {
      pen.fillStyle = colours().corner;
      pen.globalAlpha = 0.5;
      pen.fillRect(x(from), top, x(to) - x(from), height);
    }
    pen.globalAlpha = 1;
    pen.fillStyle = colours().dim;
    pen.fillText(name, x(parts[0][0]) + 3, top + 2);
  }
  pen.restore();
}

/** A field has a colour and a dash; of another car the same colour, dotted. */
function looksOf(line: Line, i: number): uPlot.Series {
  const palette = colours();
  return {
    stroke: palette.series[i % palette.series.length],
    width: palette.stroke,
    dash: line.other ? kOtherDash : kDashes[i % kDashes.length],
    points: { show: false },
    spanGaps: false,
  };
}

/** Of a chart with these lines in a box. */
export function optionsOf(axis: PlotAxis, lines: readonly Line[], box: HTMLElement): uPlot.Options {
  return {
    width: Math.max(box.clientWidth, 50),
    height: Math.max(box.clientHeight, 50),
    legend: { show: false },
    cursor: {
      sync: { key: `${kSync} ${axis}`, setSeries: false },
      points: { size: 7 },
      drag: { x: false, y: false },
    },
    scales: { x: { time: false, auto: false } },
    axes: axesOf(axis, axisUnits(lines)),
    series: [{}, ...lines.map((line, i) => looksOf(line, compared.value ? line.field : i))],
    hooks:
      axis === "time"
        ? { draw: [(plot) => drawMarks(plot)] }
        : { drawAxes: [(plot) => drawCorners(plot)] },
  };
}
