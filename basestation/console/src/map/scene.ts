/**
 * What moves on the track at the moment shown, out of the fields: the own car, where the base
 * thinks it is when the link is gone, the rivals with their gaps, and the way just driven.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Fields } from "../store/fields";
import * as session from "../store/session";
import { read, shownMs } from "../view/timeline";
import { Judgement, Quality, judgementOf } from "../wire/status";
import type { Course, Point, Pose } from "./course";

const kRivals = 4;
const kTrailMs = 12_000;
const kTrailPoints = 100;

export interface Own extends Pose {
  quality: Quality;
}

export interface Ghost extends Pose {
  radius: number;
}

export interface Rival extends Pose {
  identity: number;
  station: number;
  offset: number;
  gap: number;
  closing: number;
  stale: boolean;
}

export interface TrailPoint extends Point {
  judgement: Judgement;
}

const valueOf = (store: Fields, path: string): { value: number; quality: Quality } => {
  const { value, quality } = read(store.slot(path));
  return { value, quality };
};

export function own(store: Fields): Own | null {
  const x = valueOf(store, "ego.x");
  const y = valueOf(store, "ego.y");
  const yaw = valueOf(store, "ego.yaw");
  if (x.quality === Quality.never || !Number.isFinite(x.value + y.value)) return null;
  return { x: x.value, y: y.value, yaw: yaw.value || 0, quality: x.quality };
}

/** Where the car wants to drive, metres left of the centre; null where it has not said lately. */
export function lineOffset(store: Fields): number | null {
  const { value, quality } = valueOf(store, "planner.line_offset");
  return quality < Quality.stale && Number.isFinite(value) ? value : null;
}

export function ghost(store: Fields): Ghost | null {
  const x = valueOf(store, "derived.ghost_x");
  const y = valueOf(store, "derived.ghost_y");
  if (x.quality >= Quality.stale || !Number.isFinite(x.value + y.value)) return null;
  return {
    x: x.value,
    y: y.value,
    yaw: valueOf(store, "derived.ghost_yaw").value || 0,
    radius: valueOf(store, "derived.ghost_radius").value || 0,
  };
}

export function rivals(store: Fields, course: Course): Rival[] {
  const here = valueOf(store, "track.station").value;
  const speed = valueOf(store, "ego.vx").value;
  const found: Rival[] = [];
  for (let n = 1; n <= kRivals; ++n) {
    const identity = valueOf(store, `opponent_${n}.identity`);
    const station = valueOf(store, `opponent_${n}.station`);
    const offset = valueOf(store, `opponent_${n}.offset`);
    if (identity.quality === Quality.never || !Number.isFinite(station.value)) continue;
    if (!(identity.value > 0)) continue;
    found.push({
      ...course.place(station.value, offset.value || 0),
      identity: identity.value,
      station: station.value,
      offset: offset.value || 0,
      gap: course.gap(here, station.value),
      closing: valueOf(store, `opponent_${n}.speed`).value - speed,
      stale: station.quality >= Quality.stale,
    });
  }
  return found;
}

/** The last seconds of the own car, oldest first, with what the base judged of its cross-track. */
export function trail(store: Fields): TrailPoint[] {
  const { history } = session;
  const [x, y] = [store.slot("ego.x"), store.slot("ego.y")];
  const error = store.slot("dynamics.lateral_error");
  if (x < 0 || y < 0) return [];
  const end = history.find(shownMs());
  const begin = Math.max(history.find(shownMs() - kTrailMs), 0);
  const step = Math.max(1, Math.floor((end - begin) / kTrailPoints));
  const points: TrailPoint[] = [];
  for (let n = begin - (begin % step); n <= end; n += step) {
    const row = history.index(n);
    if ((history.status[x][row] & 3) >= Quality.stale) continue;
    points.push({
      x: history.value[x][row],
      y: history.value[y][row],
      judgement: error < 0 ? Judgement.none : judgementOf(history.status[error][row]),
    });
  }
  return points;
}
