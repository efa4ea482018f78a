/**
 * One chart: lines with gaps where nothing was known, over time or lap over lap by distance, and a
 * cursor shared by all charts that reads values while the data runs on.
 */
// SPDX-License-Identifier: Apache-2.0
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { useEffect, useRef } from "preact/hooks";
import * as session from "../../store/session";
import { theme } from "../../theme/theme";
import { kDash } from "../../view/format";
import { kDigitsHz, kPlotsHz, addPainter } from "../../view/painting";
import { shownText } from "../../view/shown_unit";
import { speedUnit } from "../../view/speed_unit";
import { shownMs } from "../../view/timeline";
import { finderShown } from "../../frame/keys";
import { optionsOf } from "./drawing";
import { plotTarget } from "./finder_target";
import { removeChart } from "./layout";
import type { ChartSpec, PlotAxis } from "./layout";
import {
  compared,
  dataOfLaps,
  dataOfTime,
  headingOf,
  inShownUnits,
  linesOf,
  nameOf,
  unitOf,
  valueAt,
} from "./lines";
import type { Line } from "./lines";

/** Where nothing is pointed at: the newest moment, or the place where the car is in its lap. */
function newest(plot: uPlot, axis: PlotAxis): number {
  const first = plot.data[1] ?? [];
  let at = plot.data[0].length - 1;
  while (axis === "distance" && at > 0 && first[at] === null) --at;
  return at;
}

/** The values under the cursor, or the newest ones, into the chart's head. */
function readOut(plot: uPlot, lines: readonly Line[], axis: PlotAxis, head: HTMLElement): void {
  const at = plot.cursor.idx ?? newest(plot, axis);
  lines.forEach((line, i) => {
    const store = line.car.fields.value;
    const info = store.info[store.slot(line.path)];
    const value = at >= 0 ? valueAt(plot.data[i + 1] ?? [], at) : null;
    const known = info && typeof value === "number";
    const text = known ? shownText(info, value / unitOf(line).factor) : kDash;
    const cell = head.children[i]?.lastElementChild;
    if (cell && cell.textContent !== text) cell.textContent = text;
  });
}

/** Beside another car a field keeps its colour in both. */
const classOf = (line: Line, i: number): string =>
  `series-${(compared.value ? line.field : i) + 1}${line.other ? " other-car" : ""}`;

export interface ChartProps {
  spec: ChartSpec;
  index: number;
  windowS: number;
  axis: PlotAxis;
}

/** What is under the lines now, and which part of the axis is in sight. */
function drawNow(
  plot: uPlot,
  spec: ChartSpec,
  lines: readonly Line[],
  axis: PlotAxis,
  windowS: number,
): void {
  const to = shownMs();
  const lengthM = session.track.value?.length_m ?? 0;
  const overLaps = axis === "distance";
  const data = overLaps
    ? dataOfLaps(spec, lengthM)
    : dataOfTime(spec, to - windowS * 1000, to, 2 * plot.width);
  const span = overLaps
    ? { min: 0, max: Math.max(lengthM, 1) }
    : { min: to / 1000 - windowS, max: to / 1000 };
  plot.batch(() => {
    plot.setData(inShownUnits(data, lines) as uPlot.AlignedData, false);
    plot.setScale("x", span);
  });
}

export function Chart({ spec, index, windowS, axis }: ChartProps) {
  const box = useRef<HTMLDivElement>(null);
  const head = useRef<HTMLUListElement>(null);
  const grounds = theme.value;
  const store = session.fields.value;
  const lines = linesOf(spec, axis);
  const heading = headingOf(spec);

  useEffect(() => {
    if (!box.current) return;
    const element = box.current;
    const empty = [[], ...lines.map(() => [])] as uPlot.AlignedData;
    const plot = new uPlot(optionsOf(axis, lines, element), empty, element);
    const paint = () => {
      if (!element.isConnected || element.clientWidth === 0) return;
      if (plot.width !== element.clientWidth || plot.height !== element.clientHeight) {
        plot.setSize({ width: element.clientWidth, height: element.clientHeight });
      }
      if (!Number.isFinite(shownMs())) return;
      drawNow(plot, spec, lines, axis, windowS);
      if (head.current) readOut(plot, lines, axis, head.current);
    };
    const stop = addPainter(paint, axis === "time" ? kPlotsHz : kDigitsHz);
    return () => {
      stop();
      plot.destroy();
    };
  }, [spec, windowS, axis, grounds, store, compared.value, speedUnit.value]);

  return (
    <section
      class="chart"
      aria-label={`chart ${heading}`}
      tabIndex={0}
      onDragOver={(e) => e.preventDefault()}
      onDrop={(e) => {
        e.preventDefault();
        const path = e.dataTransfer?.getData("text/plain");
        if (path) plotTarget.add(index, path);
      }}
    >
      <header>
        <h2>{heading}</h2>
        <ul class="read-outs" ref={head}>
          {lines.map((line, i) => (
            <li key={`${line.path} ${line.back} ${line.car.number}`} class={classOf(line, i)}>
              <i class="swatch" aria-hidden="true" />
              <span class="name">{nameOf(line)}</span>
              <span class="digits">{kDash}</span>
            </li>
          ))}
        </ul>
        <button
          type="button"
          aria-label={`add a field to ${heading}`}
          onClick={() => {
            plotTarget.chart = index;
            finderShown.value = true;
          }}
        >
          +
        </button>
        <button
          type="button"
          aria-label={`remove chart ${heading}`}
          onClick={() => removeChart(index)}
        >
          &times;
        </button>
      </header>
      <div class="plot" ref={box} />
    </section>
  );
}
