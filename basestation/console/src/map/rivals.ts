/**
 * Draws the rivals that the car tracks: a kite that points where the rival drives, its circle of
 * doubt, and a list with gap, speeds and the time since it was seen. Filled: seen lately. Dashed
 * with a dot: only carried on by the tracker. Hollow and grey: the car's report is old.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Palette } from "../theme/theme";
import { fixed } from "../view/format";
import { speedUnit } from "../view/speed_unit";
import { inkOfCar } from "./cars";
import type { Projection } from "./course";
import type { Mate, Rival } from "./scene";

type Pen = CanvasRenderingContext2D;

/** Height of a row of the list. */
export const kListPx = 22;
const kSize = 8;
const kKite = [
  [1.5, 0],
  [0, 0.85],
  [-0.9, 0],
  [0, -0.85],
] as const;
/** Of the longest text of the last column; where there is no room for it, the speeds give way. */
const kSeenPx = 112;
const kColumns = { mark: 10, name: 24, gap: 66, closing: 128, speed: 200, seen: 278 } as const;

export const gapText = (gap: number): string => `${gap >= 0 ? "+" : ""}${fixed(gap, 0)} m`;

const speedText = (mps: number): string => {
  const { name, perMps } = speedUnit.value;
  return Number.isFinite(mps) ? `${fixed(mps * perMps, 0)} ${name}` : "";
};

export const closingText = (closing: number): string =>
  `${closing >= 0 ? "+" : ""}${speedText(closing)}`;

export function seenText(rival: Rival): string {
  if (rival.stale) return "not received";
  return rival.coasts ? `seen ${fixed(rival.seenS, 1)} s ago` : "";
}

/** The mark of a rival at a pixel, pointing at an angle of the screen. */
export function kite(
  pen: Pen,
  x: number,
  y: number,
  angle: number,
  rival: Rival,
  colours: Palette,
  size = kSize,
): void {
  pen.save();
  pen.translate(x, y);
  pen.rotate(angle);
  pen.beginPath();
  for (const [u, v] of kKite) pen.lineTo(u * size, v * size);
  pen.closePath();
  pen.lineWidth = colours.stroke;
  pen.strokeStyle = rival.stale ? colours.stale : colours.rival;
  pen.fillStyle = colours.rival;
  if (rival.stale) {
    pen.stroke();
  } else if (rival.coasts) {
    pen.setLineDash([3, 2]);
    pen.stroke();
    pen.beginPath();
    pen.arc(0, 0, 2, 0, 2 * Math.PI);
    pen.fill();
  } else {
    pen.fill();
  }
  pen.restore();
}

/** The circle of doubt, in true scale; nothing where the mark hides it. */
export function doubt(
  pen: Pen,
  x: number,
  y: number,
  rival: Rival,
  perMetre: { x: number; y: number },
  colours: Palette,
): void {
  const [rx, ry] = [rival.radius * perMetre.x, rival.radius * perMetre.y];
  if (rival.stale || !(Math.max(rx, ry) > kSize)) return;
  pen.save();
  pen.strokeStyle = colours.rival;
  pen.lineWidth = colours.stroke * 0.6;
  if (rival.coasts) pen.setLineDash([4, 4]);
  pen.beginPath();
  pen.ellipse(x, y, rx, ry, 0, 0, 2 * Math.PI);
  pen.stroke();
  pen.restore();
}

/** A text that stands out from the lines behind it. */
export function outlined(pen: Pen, text: string, x: number, y: number, colours: Palette): void {
  pen.lineJoin = "round";
  pen.lineWidth = 4;
  pen.strokeStyle = colours.ground;
  pen.strokeText(text, x, y);
  pen.fillText(text, x, y);
}

/** Each rival by its number beside its mark, in the order of the road one on this side, the next
    on the other. */
export function drawRivals(
  pen: Pen,
  rivals: readonly Rival[],
  into: Projection,
  colours: Palette,
): void {
  const scale = { x: into.scale, y: into.scale };
  pen.textBaseline = "middle";
  pen.textAlign = "center";
  pen.font = "600 14px Barlow, sans-serif";
  const inOrder = rivals.toSorted((a, b) => a.gap - b.gap);
  inOrder.forEach((rival, i) => {
    const { x, y } = into.toPixel(rival.x, rival.y);
    doubt(pen, x, y, rival, scale, colours);
    kite(pen, x, y, into.toAngle(rival.yaw), rival, colours);
    const across = into.toAngle(rival.yaw + (i % 2 === 0 ? 1 : -1) * (Math.PI / 2));
    pen.fillStyle = rival.stale ? colours.stale : colours.text;
    const [u, v] = [x + 24 * Math.cos(across), y + 24 * Math.sin(across)];
    outlined(pen, `#${rival.identity}`, u, v, colours);
  });
}

/** Rivals, then the other cars of this base, in the corner, where close cars do not write over
    each other: gap, speed beside ours, speed, and since when a rival has not been seen. */
export function drawList(
  pen: Pen,
  rivals: readonly Rival[],
  mates: readonly Mate[],
  colours: Palette,
): void {
  const line = (
    row: number,
    ink: string,
    texts: Partial<Record<keyof typeof kColumns, string>>,
  ) => {
    pen.fillStyle = ink;
    for (const [column, text] of Object.entries(texts))
      pen.fillText(text, kColumns[column as keyof typeof kColumns], row);
  };
  const isWide = pen.canvas.clientWidth >= kColumns.seen + kSeenPx;
  pen.textBaseline = "middle";
  pen.textAlign = "left";
  pen.font = "600 16px Barlow, sans-serif";
  rivals.forEach((rival, i) => {
    const row = kListPx * (i + 1);
    const seen = seenText(rival);
    kite(pen, kColumns.mark, row, 0, rival, colours, 6);
    line(row, rival.stale ? colours.stale : colours.text, {
      name: `#${rival.identity}`,
      gap: gapText(rival.gap),
      ...(isWide || !seen
        ? { closing: closingText(rival.closing), speed: speedText(rival.speed), seen }
        : { closing: seen }),
    });
  });
  mates.forEach((mate, i) => {
    const row = kListPx * (rivals.length + i + 1);
    const ink = inkOfCar(mate.order, colours);
    line(row, mate.stale ? colours.stale : ink, {
      mark: `car ${mate.number}`,
      gap: Number.isFinite(mate.gap) ? gapText(mate.gap) : "",
      speed: speedText(mate.speed),
      seen: mate.stale ? "not received" : "",
    });
  });
}
