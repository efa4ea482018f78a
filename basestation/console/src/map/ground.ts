/**
 * What on the map does not move: asphalt between the walls, corners shaded, pit lane, race lines,
 * sectors, start and finish. Drawn once and kept until size, theme or track change.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Palette } from "../theme/theme";
import type { Track } from "../wire/messages";
import type { Course, Projection } from "./course";

type Pen = CanvasRenderingContext2D;

function trace(pen: Pen, points: readonly number[][], to: Projection, closed: boolean): void {
  points.forEach((point, i) => {
    const { x, y } = to.toPixel(point[0], point[1]);
    if (i === 0) pen.moveTo(x, y);
    else pen.lineTo(x, y);
  });
  if (closed) pen.closePath();
}

function shadeCorner(pen: Pen, course: Course, from: number, to: number, into: Projection): void {
  const span = course.wrapped(to - from);
  const kStepM = 8;
  const edge = (side: 1 | -1, s: number): number[] => {
    const width = course.width(s);
    const { x, y } = course.place(s, side === 1 ? width.left : -width.right);
    return [x, y];
  };
  const outline: number[][] = [];
  for (let d = 0; d <= span; d += kStepM) outline.push(edge(1, from + d));
  for (let d = span; d >= 0; d -= kStepM) outline.push(edge(-1, from + d));
  pen.beginPath();
  trace(pen, outline, into, true);
  pen.fill();
}

function across(pen: Pen, course: Course, s: number, into: Projection, beyond: number): void {
  const width = course.width(s);
  const a = course.place(s, width.left + beyond);
  const b = course.place(s, -width.right - beyond);
  const [p, q] = [into.toPixel(a.x, a.y), into.toPixel(b.x, b.y)];
  pen.beginPath();
  pen.moveTo(p.x, p.y);
  pen.lineTo(q.x, q.y);
  pen.stroke();
}

/** A word beside the road: in the infield, or outside of it. */
function label(
  pen: Pen,
  course: Course,
  s: number,
  text: string,
  into: Projection,
  outside = false,
): void {
  const width = course.width(s);
  const away = 24 / into.scale;
  const place = course.place(s, outside ? -width.right - away : width.left + away);
  const { x, y } = into.toPixel(place.x, place.y);
  pen.fillText(text, x, y);
}

/** The line that the car says it drives: so far to the left of the track's own. */
export function drawLine(
  pen: Pen,
  course: Course,
  offset: number,
  into: Projection,
  colours: Palette,
): void {
  const kStepM = 10;
  const points: number[][] = [];
  for (let s = 0; s < course.length; s += kStepM) {
    const { x, y } = course.place(s, offset);
    points.push([x, y]);
  }
  pen.save();
  pen.strokeStyle = colours.ego;
  pen.globalAlpha = 0.6;
  pen.lineWidth = colours.stroke * 0.6;
  pen.setLineDash([2, 4]);
  pen.beginPath();
  trace(pen, points, into, true);
  pen.stroke();
  pen.restore();
}

export function drawGround(pen: Pen, course: Course, into: Projection, colours: Palette): void {
  const track: Track = course.track;
  pen.beginPath();
  trace(pen, track.left, into, true);
  trace(pen, track.right, into, true);
  pen.fillStyle = colours.asphalt;
  pen.fill("evenodd");
  pen.fillStyle = colours.corner;
  for (const corner of track.corners) {
    shadeCorner(pen, course, corner.from_s, corner.to_s, into);
  }
  pen.strokeStyle = colours.dim;
  pen.lineWidth = colours.stroke * 0.6;
  for (const wall of [track.left, track.right]) {
    pen.beginPath();
    trace(pen, wall, into, true);
    pen.stroke();
  }
  pen.setLineDash([6, 5]);
  pen.beginPath();
  trace(pen, track.pit, into, false);
  pen.stroke();
  pen.setLineDash([2, 4]);
  for (const line of track.lines) {
    pen.beginPath();
    trace(pen, line.points, into, true);
    pen.stroke();
  }
  pen.setLineDash([]);
  pen.strokeStyle = colours.text;
  pen.fillStyle = colours.dim;
  pen.font = "500 14px Barlow, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.lineWidth = colours.stroke;
  across(pen, course, 0, into, 4);
  label(pen, course, 0, "S/F", into, true);
  pen.lineWidth = 1;
  track.sectors.forEach((s, i) => {
    across(pen, course, s, into, 2);
    if (i > 0 || s > 1) label(pen, course, s, `S${i + 1}`, into, true);
  });
  for (const corner of track.corners) {
    const middle = corner.from_s + course.wrapped(corner.to_s - corner.from_s) / 2;
    label(pen, course, middle, corner.name, into);
  }
}
