/**
 * The track as geometry: where a station and an offset lie in the plane, how far apart two stations
 * are on a closed line, and how the plane is fitted into a rectangle of the screen.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Track } from "../wire/messages";

export interface Point {
  x: number;
  y: number;
}

export interface Pose extends Point {
  yaw: number;
}

export interface Width {
  left: number;
  right: number;
}

export class Course {
  readonly length: number;

  constructor(readonly track: Track) {
    this.length = track.length_m;
  }

  /** Index of the centre's last point at or before station `s`. */
  private before(s: number): number {
    const { centre } = this.track;
    let low = 0;
    let high = centre.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (centre[middle][2] <= s) low = middle + 1;
      else high = middle;
    }
    return Math.max(low - 1, 0);
  }

  /** The place of station `s`, `offset` metres to the left of the centre line. */
  place(s: number, offset = 0): Pose {
    const { centre } = this.track;
    const at = this.wrapped(s);
    const i = this.before(at);
    const a = centre[i];
    const b = centre[(i + 1) % centre.length];
    const span = (i + 1 < centre.length ? b[2] : this.length) - a[2];
    const t = span > 0 ? (at - a[2]) / span : 0;
    const yaw = Math.atan2(b[1] - a[1], b[0] - a[0]);
    return {
      x: a[0] + t * (b[0] - a[0]) - offset * Math.sin(yaw),
      y: a[1] + t * (b[1] - a[1]) + offset * Math.cos(yaw),
      yaw,
    };
  }

  /** How far the walls are from the centre line at station `s`. */
  width(s: number): Width {
    const { centre, left, right } = this.track;
    if (left.length !== centre.length || right.length !== centre.length) {
      return { left: 6, right: 6 };
    }
    const i = this.before(this.wrapped(s));
    const away = (p: number[]) => Math.hypot(p[0] - centre[i][0], p[1] - centre[i][1]);
    return { left: away(left[i]), right: away(right[i]) };
  }

  wrapped(s: number): number {
    const rest = s % this.length;
    return rest < 0 ? rest + this.length : rest;
  }

  /** From one station to another the shorter way, positive ahead. */
  gap(from: number, to: number): number {
    const ahead = this.wrapped(to - from);
    return ahead > this.length / 2 ? ahead - this.length : ahead;
  }
}

/** Maps metres (x east, y north) to pixels (x right, y down), perhaps turned by a quarter. */
export interface Projection {
  scale: number;
  turned: boolean;
  toPixel(x: number, y: number): Point;
  /** Direction on the screen of a yaw in the plane, for canvas rotation. */
  toAngle(yaw: number): number;
}

/** All points inside the margins of a canvas, below `top` pixels that are kept free. */
export function fit(
  points: readonly number[][],
  width: number,
  height: number,
  margin: number,
  top = 0,
): Projection {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, y] of points) {
    x0 = Math.min(x0, x);
    x1 = Math.max(x1, x);
    y0 = Math.min(y0, y);
    y1 = Math.max(y1, y);
  }
  if (!(x1 > x0)) [x0, x1, y0, y1] = [-200, 200, -200, 200];
  const [w, h] = [Math.max(width - 2 * margin, 1), Math.max(height - top - 2 * margin, 1)];
  const upright = Math.min(w / (x1 - x0), h / (y1 - y0));
  const onSide = Math.min(w / (y1 - y0), h / (x1 - x0));
  const turned = onSide > 1.1 * upright;
  const scale = turned ? onSide : upright;
  const [cx, cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
  return {
    scale,
    turned,
    toPixel(x, y) {
      const [u, v] = turned ? [-(y - cy), x - cx] : [x - cx, y - cy];
      return { x: width / 2 + scale * u, y: (height + top) / 2 - scale * v };
    },
    toAngle: (yaw) => -(turned ? yaw + Math.PI / 2 : yaw),
  };
}
