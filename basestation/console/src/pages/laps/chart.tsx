/**
 * One chart over the stations of the track: the lap that is looked at, the reference behind it, the
 * corners, and the place where the car is at the moment shown. All of them share one cursor.
 */
// SPDX-License-Identifier: Apache-2.0
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { useEffect, useRef } from "preact/hooks";
import * as session from "../../store/session";
import { colours, theme } from "../../theme/theme";
import { fixed, kDash, signedText } from "../../view/format";
import { kDigitsHz, addPainter } from "../../view/painting";
import { axesOf, drawCorners } from "../plots/drawing";
import type { Column } from "./comparison";

export interface LapChartSpec {
  title: string;
  unit: string;
  decimals: number;
  /** A difference has its sign, and a line at zero. */
  signed?: boolean;
}

/** What is drawn now: columns in the order of `names`, and the point where the car is. */
export interface Drawn {
  stationM: number[];
  columns: Column[];
  at: number;
}

function drawLine(plot: uPlot, from: [number, number], to: [number, number], dash: number[]): void {
  const pen = plot.ctx;
  pen.save();
  pen.strokeStyle = colours().dim;
  pen.lineWidth = 1;
  pen.setLineDash(dash);
  pen.beginPath();
  pen.moveTo(...from);
  pen.lineTo(...to);
  pen.stroke();
  pen.restore();
}

function optionsOf(
  spec: LapChartSpec,
  lines: number,
  box: HTMLElement,
  placeM: () => number | null,
): uPlot.Options {
  const palette = colours();
  const draw = (plot: uPlot) => {
    const { left, top, width, height } = plot.bbox;
    const zero = plot.valToPos(0, "y", true);
    if (spec.signed && zero > top && zero < top + height) {
      drawLine(plot, [left, zero], [left + width, zero], []);
    }
    const m = placeM();
    if (m === null) return;
    const x = plot.valToPos(m, "x", true);
    drawLine(plot, [x, top], [x, top + height], [4, 4]);
  };
  return {
    width: Math.max(box.clientWidth, 50),
    height: Math.max(box.clientHeight, 50),
    legend: { show: false },
    cursor: {
      sync: { key: "laps compared", setSeries: false },
      points: { size: 7 },
      drag: { x: false, y: false },
    },
    scales: { x: { time: false, auto: false } },
    axes: axesOf("distance", spec.unit),
    series: [
      {},
      ...Array.from({ length: lines }, (_, i) => ({
        stroke: palette.series[i],
        width: palette.stroke,
        dash: i === 0 ? [] : [8, 4],
        points: { show: false },
        spanGaps: false,
      })),
    ],
    hooks: { drawAxes: [(plot) => drawCorners(plot)], draw: [draw] },
  };
}

const textOf = (value: number | null | undefined, spec: LapChartSpec): string => {
  if (typeof value !== "number") return kDash;
  const digits = spec.signed ? signedText(value, spec.decimals) : fixed(value, spec.decimals);
  return `${digits} ${spec.unit}`;
};

export interface LapChartProps {
  spec: LapChartSpec;
  /** What each line is, for the head of the chart. */
  names: readonly string[];
  draw: () => Drawn | null;
}

export function LapChart({ spec, names, draw }: LapChartProps) {
  const box = useRef<HTMLDivElement>(null);
  const head = useRef<HTMLUListElement>(null);
  const now = useRef(draw);
  now.current = draw;
  const grounds = theme.value;

  useEffect(() => {
    if (!box.current) return;
    const element = box.current;
    const empty = [[], ...names.map(() => [])] as uPlot.AlignedData;
    let drawn: Drawn | null = null;
    const placeM = () => (drawn && drawn.at >= 0 ? drawn.stationM[drawn.at] : null);
    const plot = new uPlot(optionsOf(spec, names.length, element, placeM), empty, element);
    const paint = () => {
      if (!element.isConnected || element.clientWidth === 0) return;
      if (plot.width !== element.clientWidth || plot.height !== element.clientHeight) {
        plot.setSize({ width: element.clientWidth, height: element.clientHeight });
      }
      drawn = now.current();
      const data = drawn ? [drawn.stationM, ...drawn.columns] : empty;
      plot.batch(() => {
        plot.setData(data as uPlot.AlignedData, false);
        plot.setScale("x", {
          min: 0,
          max: Math.max(session.shownCar.value.laps.table.value?.length_m ?? 0, 1),
        });
      });
      const at = plot.cursor.idx ?? drawn?.at ?? -1;
      names.forEach((_, i) => {
        const cell = head.current?.children[i]?.lastElementChild;
        const text = textOf(drawn?.columns[i]?.[at], spec);
        if (cell && cell.textContent !== text) cell.textContent = text;
      });
    };
    const stop = addPainter(paint, kDigitsHz);
    return () => {
      stop();
      plot.destroy();
    };
  }, [spec, names.length, grounds]);

  return (
    <section class="chart" aria-label={`laps compared: ${spec.title}`}>
      <header>
        <h2>{spec.title}</h2>
        <ul class="read-outs" ref={head}>
          {names.map((name, i) => (
            <li key={i} class={`series-${i + 1}`}>
              <i class="swatch" aria-hidden="true" />
              <span class="name">{name}</span>
              <span class="digits">{kDash}</span>
            </li>
          ))}
        </ul>
      </header>
      <div class="plot" ref={box} />
    </section>
  );
}
