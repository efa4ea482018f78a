/**
 * What moves on the track at the moment shown, out of the fields: the own car, where the base
 * thinks it is when the link is gone, the rivals that it tracks, the other cars of this base, and
 * the way just driven.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Fields } from "../store/fields";
import { kNothing } from "../store/reading";
import type { Reading } from "../store/reading";
import * as session from "../store/session";
import { isLive, read, shownMs } from "../view/timeline";
import { Judgement, Quality, judgementOf } from "../wire/status";
import type { Course, Point, Pose } from "./course";

/** As many as the car tells of. */
export const kRivals = 4;
/** Without a detection for longer, the car's tracker only carries the rival on. */
export const kCoastsAfterS = 0.5;
/** A rival of which the car says nothing for so long, and does of itself, is gone. */
export const kForgottenMs = 10_000;
/** The circle around a rival: so many standard deviations of its place, in the worst direction. */
export const kSigmas = 2;
const kTrailMs = 12_000;
const kTrailPoints = 100;

export interface Own extends Pose {
  quality: Quality;
}

export interface Ghost extends Pose {
  radius: number;
}

/** `seenS` is the time since its last detection, `radius` that of its circle in metres. */
export interface Rival extends Pose {
  identity: number;
  station: number;
  offset: number;
  gap: number;
  speed: number;
  closing: number;
  seenS: number;
  radius: number;
  coasts: boolean;
  stale: boolean;
}

/** Another car of this base; `order` is that of the cars, from 1. */
export interface Mate extends Pose {
  number: number;
  order: number;
  gap: number;
  speed: number;
  stale: boolean;
}

export interface TrailPoint extends Point {
  judgement: Judgement;
}

const scratch: Reading = { ...kNothing };

const valueOf = (store: Fields, path: string): Pick<Reading, "value" | "quality" | "ageMs"> => {
  const { value, quality, ageMs } = read(store.slot(path));
  return { value, quality, ageMs };
};

/** Whether the car no longer tells of a rival, `opponent_1` or another, which it did once. */
export function isGone(store: Fields, group: string): boolean {
  const { quality, ageMs } = valueOf(store, `${group}.station`);
  const isOld = quality === Quality.stale && ageMs > kForgottenMs;
  return isOld && valueOf(store, "ego.x").quality < Quality.stale;
}

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
    if (!(identity.value > 0) || isGone(store, `opponent_${n}`)) continue;
    const rivalSpeed = valueOf(store, `opponent_${n}.speed`).value;
    const seenS = valueOf(store, `opponent_${n}.age`).value;
    found.push({
      ...course.place(station.value, offset.value || 0),
      identity: identity.value,
      station: station.value,
      offset: offset.value || 0,
      gap: course.gap(here, station.value),
      speed: rivalSpeed,
      closing: rivalSpeed - speed,
      seenS,
      radius: kSigmas * valueOf(store, `opponent_${n}.position_sigma`).value || 0,
      coasts: seenS > kCoastsAfterS,
      stale: station.quality >= Quality.stale,
    });
  }
  return found;
}

/** The other cars of the base on the same track, at the moment shown: by the pose that each of them
    reported, or by its station where it has no pose. */
export function mates(course: Course): Mate[] {
  const here = valueOf(session.fields.value, "track.station").value;
  const localMs = performance.now();
  return session.cars.value.flatMap((car, i): Mate[] => {
    if (car === session.shownCar.value || car.track.value?.name !== course.track.name) return [];
    const history = car.history.value;
    const at = history.find(shownMs());
    const reading = (path: string) => ({
      ...history.read(car.fields.value.slot(path), at, scratch),
    });
    const [x, y, station] = [reading("ego.x"), reading("ego.y"), reading("track.station")];
    const isPlaced = Number.isFinite(x.value + y.value);
    if (station.quality === Quality.never || !Number.isFinite(station.value)) return [];
    const silent = isLive.value && car.clock.isSilent(localMs);
    return [
      {
        ...(isPlaced
          ? { x: x.value, y: y.value, yaw: reading("ego.yaw").value || 0 }
          : course.place(station.value, reading("track.offset").value || 0)),
        number: car.number ?? 0,
        order: i + 1,
        gap: course.gap(here, station.value),
        speed: reading("ego.vx").value,
        stale: silent || !car.connected.value || station.quality >= Quality.stale,
      },
    ];
  });
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
