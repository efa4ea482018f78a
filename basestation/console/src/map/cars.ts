/**
 * Draws what moves: the own car filled, its ghost hollow with a circle of doubt, rivals as diamonds
 * with gap and closing speed, the trail in colour only where it was out of line.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Palette } from "../theme/theme";
import { fixed } from "../view/format";
import { speedUnit } from "../view/speed_unit";
import { Judgement, Quality } from "../wire/status";
import type { Pose, Projection } from "./course";
import type { Ghost, Own, Rival, TrailPoint } from "./scene";

type Pen = CanvasRenderingContext2D;

/** Height of a row of the list of rivals. */
const kListPx = 22;
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

export function drawOwn(pen: Pen, own: Own, into: Projection, colours: Palette): void {
  arrow(pen, own, into);
  if (own.quality >= Quality.stale) {
    pen.setLineDash([3, 3]);
    pen.strokeStyle = colours.stale;
    pen.lineWidth = colours.stroke;
    pen.stroke();
    pen.setLineDash([]);
    return;
  }
  pen.fillStyle = colours.ego;
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

export const gapText = (gap: number): string => `${gap >= 0 ? "+" : ""}${fixed(gap, 0)} m`;

export function closingText(closing: number): string {
  if (!Number.isFinite(closing)) return "";
  const { name, perMps } = speedUnit.value;
  return `${closing >= 0 ? "+" : ""}${fixed(closing * perMps, 0)} ${name}`;
}

/** A diamond of a rival at a pixel; hollow once its report is stale. */
export function diamond(
  pen: Pen,
  x: number,
  y: number,
  size: number,
  stale: boolean,
  colours: Palette,
): void {
  pen.beginPath();
  pen.moveTo(x, y - size);
  pen.lineTo(x + size, y);
  pen.lineTo(x, y + size);
  pen.lineTo(x - size, y);
  pen.closePath();
  pen.lineWidth = colours.stroke;
  if (stale) {
    pen.strokeStyle = colours.stale;
    pen.stroke();
    return;
  }
  pen.fillStyle = colours.rival;
  pen.fill();
}

/** Each rival by its number beside its diamond, and once more in the corner with gap and closing
    speed, where close cars do not write over each other. */
export function drawRivals(
  pen: Pen,
  rivals: readonly Rival[],
  into: Projection,
  colours: Palette,
): void {
  pen.textBaseline = "middle";
  rivals.forEach((rival, i) => {
    const { x, y } = into.toPixel(rival.x, rival.y);
    const ink = rival.stale ? colours.stale : colours.text;
    diamond(pen, x, y, 8, rival.stale, colours);
    const across = into.toAngle(rival.yaw + Math.PI / 2);
    pen.font = "600 14px Barlow, sans-serif";
    pen.textAlign = "center";
    pen.fillStyle = ink;
    pen.fillText(`#${rival.identity}`, x + 24 * Math.cos(across), y + 24 * Math.sin(across));
    const row = kListPx + i * kListPx;
    diamond(pen, 10, row, 6, rival.stale, colours);
    pen.fillStyle = ink;
    pen.font = "600 16px Barlow, sans-serif";
    pen.textAlign = "left";
    pen.fillText(`#${rival.identity}`, 24, row);
    pen.fillText(gapText(rival.gap), 60, row);
    pen.fillText(closingText(rival.closing), 124, row);
  });
}
