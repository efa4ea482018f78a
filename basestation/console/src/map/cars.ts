/**
 * Draws the cars of this base: the one that is shown filled, its ghost hollow with a circle of
 * doubt, the others smaller in their colours with their numbers; the trail in colour only where it
 * was out of line.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Palette } from "../theme/theme";
import { Judgement, Quality } from "../wire/status";
import type { Pose, Projection } from "./course";
import type { Ghost, Mate, Own, TrailPoint } from "./scene";

type Pen = CanvasRenderingContext2D;

const kMateSize = 0.8;
const kArrow = [
  [13, 0],
  [-9, 8],
  [-5, 0],
  [-9, -8],
] as const;

/** A car as an arrow at its place, pointing where it points. */
function arrow(pen: Pen, pose: Pose, into: Projection, size = 1): void {
  const { x, y } = into.toPixel(pose.x, pose.y);
  pen.save();
  pen.translate(x, y);
  pen.rotate(into.toAngle(pose.yaw));
  pen.beginPath();
  for (const [u, v] of kArrow) pen.lineTo(u * size, v * size);
  pen.closePath();
  pen.restore();
}

function inkOf(judgement: Judgement, colours: Palette): string {
  if (judgement === Judgement.bad) return colours.bad;
  return judgement === Judgement.warning ? colours.warning : colours.ego;
}

export function drawTrail(
  pen: Pen,
  points: readonly TrailPoint[],
  into: Projection,
  colours: Palette,
  stale: boolean,
): void {
  pen.lineWidth = colours.stroke * 1.5;
  pen.lineJoin = "round";
  for (let i = 1; i < points.length; ++i) {
    const [a, b] = [points[i - 1], points[i]];
    const [p, q] = [into.toPixel(a.x, a.y), into.toPixel(b.x, b.y)];
    pen.strokeStyle = stale ? colours.stale : inkOf(b.judgement, colours);
    pen.globalAlpha =
      (b.judgement >= Judgement.warning ? 1 : 0.75) * (0.15 + 0.85 * (i / points.length));
    pen.beginPath();
    pen.moveTo(p.x, p.y);
    pen.lineTo(q.x, q.y);
    pen.stroke();
  }
  pen.globalAlpha = 1;
}

/** The ink of a car of a base that has several, by its place among them from 1. */
export const inkOfCar = (order: number, colours: Palette): string =>
  colours.cars[(order - 1) % colours.cars.length];

/** The number of a car beside its arrow. */
function numbered(pen: Pen, car: Pose, number: number, into: Projection): void {
  const { x, y } = into.toPixel(car.x, car.y);
  const across = into.toAngle(car.yaw - Math.PI / 2);
  pen.font = "700 16px Barlow, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillText(`${number}`, x + 22 * Math.cos(across), y + 22 * Math.sin(across));
}

/** `order` and `number` where the base has several cars. */
export function drawOwn(
  pen: Pen,
  own: Own,
  into: Projection,
  colours: Palette,
  among: { order: number; number: number } | null = null,
): void {
  const ink = among ? inkOfCar(among.order, colours) : colours.ego;
  pen.fillStyle = own.quality >= Quality.stale ? colours.stale : ink;
  if (among) numbered(pen, own, among.number, into);
  arrow(pen, own, into);
  if (own.quality >= Quality.stale) {
    pen.setLineDash([3, 3]);
    pen.strokeStyle = colours.stale;
    pen.lineWidth = colours.stroke;
    pen.stroke();
    pen.setLineDash([]);
    return;
  }
  pen.fillStyle = ink;
  pen.strokeStyle = colours.ground;
  pen.lineWidth = 2;
  pen.fill();
  pen.stroke();
}

export function drawGhost(pen: Pen, ghost: Ghost, into: Projection, colours: Palette): void {
  const { x, y } = into.toPixel(ghost.x, ghost.y);
  pen.strokeStyle = colours.text;
  pen.lineWidth = colours.stroke;
  arrow(pen, ghost, into);
  pen.stroke();
  pen.setLineDash([4, 4]);
  pen.beginPath();
  pen.arc(x, y, Math.max(ghost.radius * into.scale, 16), 0, 2 * Math.PI);
  pen.stroke();
  pen.setLineDash([]);
}

/** The other cars of this base, each with its number beside it; hollow once it is not heard. */
export function drawMates(
  pen: Pen,
  mates: readonly Mate[],
  into: Projection,
  colours: Palette,
): void {
  for (const mate of mates) {
    const ink = mate.stale ? colours.stale : inkOfCar(mate.order, colours);
    arrow(pen, mate, into, kMateSize);
    pen.lineWidth = colours.stroke;
    pen.strokeStyle = mate.stale ? ink : colours.ground;
    pen.fillStyle = ink;
    if (!mate.stale) pen.fill();
    pen.stroke();
    numbered(pen, mate, mate.number, into);
  }
}
