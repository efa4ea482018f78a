/**
 * The lines of a chart and what is under them: fields of the car that is shown over time or over
 * its newest laps, and beside each the same field of another car of this base, on the same axis.
 */
// SPDX-License-Identifier: Apache-2.0
import { computed, signal } from "@preact/signals";
import uPlot from "uplot";
import type { CarSession } from "../../store/car_session";
import * as session from "../../store/session";
import { shownUnit } from "../../view/shown_unit";
import type { ShownUnit } from "../../view/shown_unit";
import { shownMs } from "../../view/timeline";
import { earlierOf } from "./backfill";
import { lapColumns } from "./laps";
import { lapsBeside } from "./layout";
import type { ChartSpec, PlotAxis } from "./layout";
import { columns, withEarlier } from "./series";
import type { Column, Columns } from "./series";

/** A line of a chart: a field over time, or over one of its newest laps. */
export interface Line {
  path: string;
  /** Laps before the newest one. */
  back: number;
  car: CarSession;
  /** Of the car that is compared, not of the one that is shown. */
  other: boolean;
  /** Place of the field in the chart: both cars' lines have its colour. */
  field: number;
}

/** A value that falls between those of a line is not known, and no gap in it. */
export type Joined = (number | null | undefined)[];

/** The number of the car that the plots compare with; null: none. */
export const comparedNumber = signal<number | null>(null);
/** That car, where it is here and is not the one that is shown. */
export const compared = computed(
  () =>
    session.cars.value.find(
      (car) => car.number === comparedNumber.value && car !== session.shownCar.value,
    ) ?? null,
);

const lapsShown = (spec: ChartSpec): number =>
  compared.value ? 1 : lapsBeside(spec.fields.length);

export function linesOf(spec: ChartSpec, axis: PlotAxis): Line[] {
  const laps = axis === "time" ? 1 : lapsShown(spec);
  const car = session.shownCar.value;
  const other = compared.value;
  return spec.fields.flatMap((path, field) => {
    const own = Array.from({ length: laps }, (_, back) => ({
      path,
      back,
      car,
      other: false,
      field,
    }));
    return other ? [...own, { path, back: 0, car: other, other: true, field }] : own;
  });
}

/** What the base calls a field; its path where the base does not know it. */
export function titleOf(path: string, car = session.shownCar.value): string {
  const store = car.fields.value;
  return store.info[store.slot(path)]?.title ?? path;
}

/** A chart of one field is named by its path, and shows its title. */
export const headingOf = (spec: ChartSpec): string => titleOf(spec.title);

/** The newest lap has the field's title; the others, and the other car, follow it. */
export const nameOf = ({ path, back, car, other }: Line): string =>
  other ? `car ${car.number}` : back === 0 ? titleOf(path, car) : `lap \u2212${back}`;

/** The unit in which a line is drawn; none for a field that the base does not have. */
export function unitOf({ path, car }: Line): ShownUnit {
  const store = car.fields.value;
  return shownUnit(store.info[store.slot(path)]?.unit ?? "");
}

/**
 * The columns of a chart in the units that are shown. Those of another car may come a frame before
 * the lines that name them.
 */
export function inShownUnits(
  [along, ...columns]: [number[], ...Joined[]],
  lines: readonly Line[],
): [number[], ...Joined[]] {
  const scaled = columns.map((column, i) => {
    const factor = lines[i] ? unitOf(lines[i]).factor : 1;
    return factor === 1 ? column : column.map((value) => value && value * factor);
  });
  return [along, ...scaled];
}

/** The units of an axis that several lines share. */
export const axisUnits = (lines: readonly Line[]): string =>
  [...new Set(lines.map((line) => unitOf(line).name))].filter(Boolean).join(", ");

/** The columns of two cars in turn, field by field. */
const inTurn = <T>(own: readonly T[][], other: readonly T[] | null): T[] =>
  own.flatMap((mine, i) => (other ? [...mine, other[i]] : mine));

function lapsOfCar(car: CarSession, spec: ChartSpec, lengthM: number, most: number) {
  const store = car.fields.value;
  const { stationM, values } = lapColumns(
    car.history.value,
    { station: store.slot("track.station"), lap: store.slot("track.lap") },
    spec.fields.map((path) => store.slot(path)),
    lengthM,
    shownMs(),
    most,
  );
  const none: Column = stationM.map(() => null);
  const filled = values.map((laps) => Array.from({ length: most }, (_, i) => laps[i] ?? none));
  return { stationM, values: filled };
}

/** As many columns as the chart has lines, empty where no lap is. */
export function dataOfLaps(spec: ChartSpec, lengthM: number): [number[], ...Joined[]] {
  const { stationM, values } = lapsOfCar(session.shownCar.value, spec, lengthM, lapsShown(spec));
  const other = compared.value ? lapsOfCar(compared.value, spec, lengthM, 1).values : null;
  return [stationM, ...inTurn(values, other?.map(([newest]) => newest) ?? null)];
}

function timesOfCar(
  car: CarSession,
  spec: ChartSpec,
  fromMs: number,
  toMs: number,
  points: number,
): Columns {
  const store = car.fields.value;
  const rows = car.history.value;
  const slots = spec.fields.map((path) => store.slot(path));
  const own = columns(rows, slots, fromMs, toMs, points);
  if (fromMs > rows.oldestMs()) return own;
  const earlier = spec.fields.map((path) => earlierOf(path, car));
  return withEarlier(own, earlier, fromMs / 1000);
}

/** Both cars are on the base's one clock: moments of either stand on the same axis. */
export function dataOfTime(
  spec: ChartSpec,
  fromMs: number,
  toMs: number,
  points: number,
): [number[], ...Joined[]] {
  const own = timesOfCar(session.shownCar.value, spec, fromMs, toMs, points);
  if (!compared.value) return [own.timeS, ...own.values];
  const other = timesOfCar(compared.value, spec, fromMs, toMs, points);
  const [timeS, ...values] = uPlot.join([
    [own.timeS, ...own.values],
    [other.timeS, ...other.values],
  ]) as [number[], ...Joined[]];
  const fields = spec.fields.length;
  const mine = values.slice(0, fields).map((column) => [column]);
  return [timeS, ...inTurn(mine, values.slice(fields))];
}

/** The value of a line at or right before a place of the axis. */
export function valueAt(column: ArrayLike<number | null | undefined>, at: number): number | null {
  let i = at;
  while (i > 0 && column[i] === undefined) --i;
  return column[i] ?? null;
}
