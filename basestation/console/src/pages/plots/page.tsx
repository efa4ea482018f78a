/**
 * The plots page: up to 24 charts over one time axis, by preset or as the operator put them
 * together.
 */
// SPDX-License-Identifier: Apache-2.0
import { useEffect } from "preact/hooks";
import * as session from "../../store/session";
import { finderShown } from "../../frame/keys";
import { LapsCompared } from "../laps/view";
import { Chart } from "./chart";
import { forgetEarlier, requestEarlier } from "./backfill";
import { changeLayout, kPresets, kWindowsS, plotLayout } from "./layout";
import type { PlotAxis, PlotLayout } from "./layout";
import { compared, comparedNumber } from "./lines";

const columnsFor = (charts: number): number =>
  charts <= 1 ? 1 : charts <= 8 ? 2 : charts <= 15 ? 3 : 4;

/** The same fields of another car of this base, in the same charts. */
function CompareWith() {
  const others = session.cars.value.filter((car) => car !== session.shownCar.value);
  return (
    <label>
      beside car
      <select
        value={String(compared.value?.number ?? "")}
        onChange={(e) => {
          const { value } = e.currentTarget;
          comparedNumber.value = value === "" ? null : Number(value);
        }}
      >
        <option value="">none</option>
        {others.map(({ number }) => (
          <option value={String(number)} key={number}>
            {number}
          </option>
        ))}
      </select>
    </label>
  );
}

function Charts({ layout, axis }: { layout: PlotLayout; axis: PlotAxis }) {
  return (
    <div
      class="charts"
      style={{
        gridTemplateColumns: `repeat(${columnsFor(layout.charts.length)}, minmax(0, 1fr))`,
      }}
    >
      {layout.charts.map((spec, i) => (
        <Chart
          spec={spec}
          index={i}
          windowS={layout.window_s}
          axis={axis}
          key={spec.title + spec.fields}
        />
      ))}
      {layout.charts.length === 0 && <p class="empty">Press / to add a field.</p>}
    </div>
  );
}

export function PlotsPage() {
  const layout = plotLayout.value;
  const axis = layout.axis ?? "time";
  const other = compared.value;
  const ready = session.fields.value.info.length > 0;
  const jumps = session.playback.value?.jumps;
  useEffect(forgetEarlier, [jumps]);
  useEffect(() => {
    if (!ready) return;
    const paths = layout.charts.flatMap((chart) => chart.fields);
    paths.forEach((path) => requestEarlier(path));
    if (other) paths.forEach((path) => requestEarlier(path, other));
  }, [layout, ready, other, jumps]);
  return (
    <main class="page plots">
      <div class="tools" role="toolbar" aria-label="plots">
        {Object.keys(kPresets).map((name) => (
          <button
            type="button"
            key={name}
            aria-pressed={layout.charts === kPresets[name].charts}
            onClick={() =>
              changeLayout({
                ...kPresets[name],
                window_s: layout.window_s,
                axis: axis === "laps" ? "time" : axis,
              })
            }
          >
            {name}
          </button>
        ))}
        <label>
          over
          <select
            value={axis}
            onChange={(e) =>
              changeLayout({ ...layout, axis: e.currentTarget.value as typeof axis })
            }
          >
            <option value="time">time</option>
            <option value="distance">distance, lap by lap</option>
            <option value="laps">distance, against a reference lap</option>
          </select>
        </label>
        <label>
          window
          <select
            disabled={axis !== "time"}
            value={String(layout.window_s)}
            onChange={(e) => changeLayout({ ...layout, window_s: Number(e.currentTarget.value) })}
          >
            {kWindowsS.map((s) => (
              <option value={String(s)} key={s}>
                {s} s
              </option>
            ))}
          </select>
        </label>
        <button type="button" onClick={() => (finderShown.value = true)}>
          Add field <kbd>/</kbd>
        </button>
        {session.hasSeveral.value && <CompareWith />}
        {axis !== "time" && !session.track.value && (
          <span class="sum">Without a track there is no distance.</span>
        )}
      </div>
      {axis === "laps" ? <LapsCompared /> : <Charts layout={layout} axis={axis} />}
    </main>
  );
}
