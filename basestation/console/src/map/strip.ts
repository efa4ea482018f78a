/**
 * The road around the car, straightened: 80 m behind to 160 m ahead, walls, own car and rivals at
 * their offsets. Shows sideways what the map is too small for.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Palette } from "../theme/theme";
import { captionHeights } from "./captions";
import type { Course } from "./course";
import { closingText, doubt, gapText, kite, outlined, seenText } from "./rivals";
import type { Rival } from "./scene";

type Pen = CanvasRenderingContext2D;

const kBehindM = 80;
const kAheadM = 160;
const kStepM = 4;
const kHalfHeightM = 16;
const kRungsM = [-60, -30, 30, 60, 90, 120, 150] as const;

export interface StripState {
  station: number;
  offset: number;
  stale: boolean;
  /** Offset of the line that the car drives, null where it has not said. */
  line: number | null;
  rivals: readonly Rival[];
}

function rungs(pen: Pen, x: (s: number) => number, here: number, height: number): void {
  pen.textAlign = "center";
  pen.textBaseline = "bottom";
  pen.font = "400 14px Barlow, sans-serif";
  for (const ahead of kRungsM) {
    const at = x(here + ahead);
    pen.beginPath();
    pen.moveTo(at, height - 16);
    pen.lineTo(at, height - 22);
    pen.stroke();
    pen.fillText(`${ahead > 0 ? "+" : "\u2212"}${Math.abs(ahead)}`, at, height - 1);
  }
}

export function drawStrip(
  pen: Pen,
  course: Course,
  state: StripState,
  colours: Palette,
  width: number,
  height: number,
): void {
  const road = height - 24;
  const x = (s: number) => ((s - state.station + kBehindM) / (kBehindM + kAheadM)) * width;
  const y = (offset: number) => (road / 2) * (1 - offset / kHalfHeightM);
  const edge = (side: 1 | -1): [number, number][] => {
    const points: [number, number][] = [];
    for (let d = -kBehindM; d <= kAheadM; d += kStepM) {
      const w = course.width(state.station + d);
      points.push([x(state.station + d), y(side === 1 ? w.left : -w.right)]);
    }
    return points;
  };
  const [left, right] = [edge(1), edge(-1)];
  pen.beginPath();
  for (const [px, py] of left) pen.lineTo(px, py);
  for (const [px, py] of right.toReversed()) pen.lineTo(px, py);
  pen.fillStyle = colours.asphalt;
  pen.fill();
  pen.strokeStyle = colours.dim;
  pen.lineWidth = colours.stroke * 0.6;
  for (const wall of [left, right]) {
    pen.beginPath();
    for (const [px, py] of wall) pen.lineTo(px, py);
    pen.stroke();
  }
  if (state.line !== null) {
    pen.save();
    pen.strokeStyle = colours.ego;
    pen.setLineDash([2, 4]);
    pen.beginPath();
    pen.moveTo(0, y(state.line));
    pen.lineTo(width, y(state.line));
    pen.stroke();
    pen.restore();
  }
  pen.fillStyle = colours.dim;
  rungs(pen, x, state.station, height);
  drawCars(pen, state, colours, x, y, { width, height: road }, { x: x(1) - x(0), y: y(0) - y(1) });
}

/** The captions lie under the marks of all. */
function drawCars(
  pen: Pen,
  state: StripState,
  colours: Palette,
  x: (s: number) => number,
  y: (offset: number) => number,
  size: { width: number; height: number },
  perMetre: { x: number; y: number },
): void {
  const own = { x: x(state.station), y: y(state.offset) };
  const seen = state.rivals
    .filter(({ gap }) => gap >= -kBehindM && gap <= kAheadM)
    .toSorted((a, b) => a.gap - b.gap)
    .map((rival) => ({ rival, px: x(state.station + rival.gap), py: y(rival.offset) }));
  pen.fillStyle = colours.text;
  pen.font = "600 14px Barlow, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  const texts = seen.map(({ rival }) => {
    const more = seenText(rival) || closingText(rival.closing);
    return `#${rival.identity} ${gapText(rival.gap)} ${more}`;
  });
  const captions = seen.map(({ px, py }, i) => {
    const half = pen.measureText(texts[i]!).width / 2;
    return { x: Math.min(Math.max(px, half), size.width - half), half, markY: py };
  });
  const marks = [own, ...seen.map(({ px, py }) => ({ x: px, y: py }))];
  captionHeights(captions, marks, size.height).forEach((at, i) => {
    outlined(pen, texts[i]!, captions[i]!.x, at, colours);
  });
  for (const { rival, px, py } of seen) {
    doubt(pen, px, py, rival, perMetre, colours);
    kite(pen, px, py, 0, rival, colours, 7);
  }
  pen.beginPath();
  pen.moveTo(own.x + 13, own.y);
  pen.lineTo(own.x - 9, own.y + 7);
  pen.lineTo(own.x - 9, own.y - 7);
  pen.closePath();
  if (state.stale) {
    pen.strokeStyle = colours.stale;
    pen.lineWidth = colours.stroke;
    pen.stroke();
  } else {
    pen.fillStyle = colours.ego;
    pen.fill();
  }
}
