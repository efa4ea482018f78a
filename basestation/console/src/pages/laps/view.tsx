/**
 * Laps compared by station: the lap of the moment that is shown, or a chosen one, against a
 * reference. Live and in a replay the same: the base has the laps.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import * as session from "../../store/session";
import { kDigitsHz, addPainter } from "../../view/painting";
import { speedUnit } from "../../view/speed_unit";
import { shownMs } from "../../view/timeline";
import type { LapColumn, LapRow } from "../../wire/laps";
import { LapChart } from "./chart";
import type { Drawn, LapChartSpec } from "./chart";
import { columnOf, deltaOf, noDeltaText, pointAt } from "./comparison";
import type { Column, Compared } from "./comparison";
import { LapTable } from "./table";
import "./laps.css";

const kPercent = 100;

/** The lap of the moment, found anew as time goes on. */
const momentLap = signal<number | null>(null);

const shownRow = (): LapRow | null => {
  const { laps } = session.shownCar.value;
  return laps.row(laps.shown.value ?? momentLap.value);
};

function compared(row: LapRow | null): Compared | null {
  const points = row && session.shownCar.value.laps.points(row.id);
  return row && points ? { row, points } : null;
}

/** `columns` of the lap and of the reference, of which either may not be here yet. */
function drawnOf(columns: (lap: Compared, reference: Compared | null) => Column[]): Drawn | null {
  const lap = compared(shownRow());
  if (!lap) return null;
  const { stepM } = lap.points;
  return {
    stationM: Array.from(lap.points.columns.time, (_, i) => i * stepM),
    columns: columns(lap, compared(session.shownCar.value.laps.referenceRow.value)),
    at: pointAt(lap, shownMs()),
  };
}

const both = (name: LapColumn, factor: () => number) => () =>
  drawnOf((lap, reference) => [
    columnOf(lap, name, factor()),
    reference ? columnOf(reference, name, factor()) : [],
  ]);

const drawDelta = () => drawnOf((lap, reference) => [reference ? deltaOf(lap, reference) : []]);

const kDelta: LapChartSpec = {
  title: "time to the reference (+ lost)",
  unit: "s",
  decimals: 3,
  signed: true,
};
const kOthers: readonly [LapColumn, LapChartSpec, number][] = [
  ["crossTrack", { title: "cross-track error", unit: "m", decimals: 2, signed: true }, 1],
  ["throttle", { title: "throttle", unit: "%", decimals: 0 }, kPercent],
  ["brake", { title: "front brake", unit: "kPa", decimals: 0 }, 1],
];
const kOtherDraws = kOthers.map(([name, , factor]) => both(name, () => factor));
const drawSpeed = both("speed", () => speedUnit.value.perMps);

/** Keeps the points of both laps here, and the lap of the moment found. */
function keepUp(): void {
  const car = session.shownCar.value;
  const ask = (lap: number) => car.send({ type: "lap", lap });
  momentLap.value = car.laps.rowAt(shownMs())?.id ?? null;
  for (const row of [shownRow(), car.laps.referenceRow.value]) {
    if (row) car.laps.want(row, performance.now(), ask);
  }
}

export function LapsCompared() {
  useEffect(() => addPainter(keepUp, kDigitsHz), []);
  const lap = shownRow();
  const reference = session.shownCar.value.laps.referenceRow.value;
  const names = [
    lap ? `lap ${lap.id}` : "no lap",
    reference ? `reference, lap ${reference.id}` : "no reference",
  ];
  const deltaName = noDeltaText(lap, reference) || names[0];
  const { name } = speedUnit.value;
  const speed: LapChartSpec = { title: "speed", unit: name, decimals: 1 };
  return (
    <div class="laps-page">
      <LapTable shown={lap} />
      <div class="charts">
        <LapChart spec={kDelta} names={[deltaName]} draw={drawDelta} />
        <LapChart spec={speed} names={names} draw={drawSpeed} key={name} />
        {kOthers.map(([, spec], i) => (
          <LapChart spec={spec} names={names} draw={kOtherDraws[i]} key={spec.title} />
        ))}
      </div>
    </div>
  );
}
