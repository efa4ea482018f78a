/**
 * One chart: lines with gaps where nothing was known, a cursor shared by all charts that reads
 * values while the data runs on, alarms and commands as marks on the time axis.
 */
// SPDX-License-Identifier: Apache-2.0
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { useEffect, useRef } from "preact/hooks";
import * as session from "../../store/session";
import { colours, theme } from "../../theme/theme";
import { decimalsOf, fixed, kDash, unitText, valueText } from "../../view/format";
import { kPlotsHz, addPainter } from "../../view/painting";
import { shownMs } from "../../view/timeline";
import { finderShown } from "../../frame/keys";
import { earlierOf } from "./backfill";
import { drawMarks } from "./marks";
import { plotTarget } from "./finder_target";
import { removeChart } from "./layout";
import type { ChartSpec } from "./layout";
import { columns, withEarlier } from "./series";
import type { Columns } from "./series";

const kSync = "plots";
const kDashes = [[], [8, 4], [2, 3], [8, 3, 2, 3], [12, 6], [4, 6]];

function axes(): uPlot.Axis[] {
  const { dim, line } = colours();
  const font = "12px Barlow, sans-serif";
  const grid = { stroke: line, width: 1 };
  const ticks = { stroke: line, width: 1, size: 4 };
  return [
    {
      stroke: dim,
      font,
      grid,
      ticks,
      size: 26,
      space: 70,
      splits: (_, __, min, max, step) => backFrom(max, min, step),
      values: (_, splits) => splits.map((s) => agoText(s)),
    },
    {
      stroke: dim,
      font,
      grid,
      ticks,
      size: 52,
      space: 34,
      values: (_, splits, __, ___, step) => splits.map((v) => fixed(v, decimalsOf(step))),
    },
  ];
}

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

function options(spec: ChartSpec, box: HTMLElement): uPlot.Options {
  const palette = colours();
  return {
    width: Math.max(box.clientWidth, 50),
    height: Math.max(box.clientHeight, 50),
    legend: { show: false },
    cursor: {
      sync: { key: kSync, setSeries: false },
      points: { size: 7 },
      drag: { x: false, y: false },
    },
    scales: { x: { time: false, auto: false } },
    axes: axes(),
    series: [
      {},
      ...spec.fields.map((_, i) => ({
        stroke: palette.series[i % palette.series.length],
        width: palette.stroke,
        dash: kDashes[i % kDashes.length],
        points: { show: false },
        spanGaps: false,
      })),
    ],
    hooks: { draw: [(plot) => drawMarks(plot)] },
  };
}

function dataOf(spec: ChartSpec, fromMs: number, toMs: number, points: number): Columns {
  const store = session.fields.value;
  const slots = spec.fields.map((path) => store.slot(path));
  const own = columns(session.history, slots, fromMs, toMs, points);
  const oldest = session.history.oldestMs();
  if (fromMs > oldest) return own;
  return withEarlier(own, spec.fields.map(earlierOf), fromMs / 1000);
}

/** The values under the cursor, or the newest ones, into the chart's head. */
function readOut(plot: uPlot, spec: ChartSpec, head: HTMLElement): void {
  const store = session.fields.value;
  const last = plot.data[0].length - 1;
  const at = plot.cursor.idx ?? last;
  spec.fields.forEach((path, i) => {
    const info = store.info[store.slot(path)];
    const value = at >= 0 ? plot.data[i + 1]?.[at] : null;
    const text =
      info && typeof value === "number"
        ? `${valueText(info, value)} ${unitText(info.unit)}`
        : kDash;
    const cell = head.children[i]?.lastElementChild;
    if (cell && cell.textContent !== text) cell.textContent = text;
  });
}

export interface ChartProps {
  spec: ChartSpec;
  index: number;
  windowS: number;
}

export function Chart({ spec, index, windowS }: ChartProps) {
  const box = useRef<HTMLDivElement>(null);
  const head = useRef<HTMLUListElement>(null);
  const grounds = theme.value;
  const store = session.fields.value;

  useEffect(() => {
    if (!box.current) return;
    const element = box.current;
    const plot = new uPlot(options(spec, element), [[], ...spec.fields.map(() => [])], element);
    const paint = () => {
      if (!element.isConnected || element.clientWidth === 0) return;
      if (plot.width !== element.clientWidth || plot.height !== element.clientHeight) {
        plot.setSize({ width: element.clientWidth, height: element.clientHeight });
      }
      const to = shownMs();
      if (!Number.isFinite(to)) return;
      const { timeS, values } = dataOf(spec, to - windowS * 1000, to, element.clientWidth * 2);
      plot.batch(() => {
        plot.setData([timeS, ...values] as uPlot.AlignedData, false);
        plot.setScale("x", { min: to / 1000 - windowS, max: to / 1000 });
      });
      if (head.current) readOut(plot, spec, head.current);
    };
    const stop = addPainter(paint, kPlotsHz);
    return () => {
      stop();
      plot.destroy();
    };
  }, [spec, windowS, grounds, store]);

  return (
    <section
      class="chart"
      aria-label={`chart ${spec.title}`}
      tabIndex={0}
      onDragOver={(e) => e.preventDefault()}
      onDrop={(e) => {
        e.preventDefault();
        const path = e.dataTransfer?.getData("text/plain");
        if (path) plotTarget.add(index, path);
      }}
    >
      <header>
        <h2>{spec.title}</h2>
        <ul class="read-outs" ref={head}>
          {spec.fields.map((path, i) => (
            <li key={path} class={`series-${i + 1}`}>
              <i class="swatch" aria-hidden="true" />
              <span class="name">{path}</span>
              <span class="digits">{kDash}</span>
            </li>
          ))}
        </ul>
        <button
          type="button"
          aria-label={`add a field to ${spec.title}`}
          onClick={() => {
            plotTarget.chart = index;
            finderShown.value = true;
          }}
        >
          +
        </button>
        <button
          type="button"
          aria-label={`remove chart ${spec.title}`}
          onClick={() => removeChart(index)}
        >
          &times;
        </button>
      </header>
      <div class="plot" ref={box} />
    </section>
  );
}
