/**
 * The track panel: the map above, the straightened road below, and in words what a screen reader
 * cannot see. Redrawn at most 30 times a second.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { colours, theme } from "../theme/theme";
import type { Palette } from "../theme/theme";
import { kMapHz, usePainter } from "../view/painting";
import { readPath } from "../view/timeline";
import { Tile } from "../view/value";
import { Quality } from "../wire/status";
import { drawGhost, drawMates, drawOwn, drawTrail } from "./cars";
import { Course, fit } from "./course";
import type { Projection } from "./course";
import { drawGround, drawLine } from "./ground";
import { drawList, drawRivals, kListPx } from "./rivals";
import { ghost, kCoastsAfterS, kSigmas, lineOffset, mates, own, rivals, trail } from "./scene";
import { drawStrip } from "./strip";

const kMargin = 34;
/** Where the map is higher than wide the list of four rivals has its place above it. */
const kListRoomPx = 4 * kListPx;

/** Fits a canvas to its box in device pixels; true where its size changed. */
export function sizeCanvas(canvas: HTMLCanvasElement): boolean {
  const ratio = window.devicePixelRatio || 1;
  const [w, h] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (canvas.width === w && canvas.height === h) return false;
  canvas.width = w;
  canvas.height = h;
  return true;
}

/** The ground, drawn once into a canvas of its own. */
class Ground {
  private readonly canvas = document.createElement("canvas");
  private key = "";
  projection: Projection = fit([], 1, 1, 0);

  under(pen: CanvasRenderingContext2D, course: Course | null, palette: Palette): void {
    const { width, height, clientWidth, clientHeight } = pen.canvas;
    const key = `${width}x${height} ${theme.value} ${course?.track.name ?? ""}`;
    if (key !== this.key) {
      this.key = key;
      this.canvas.width = width;
      this.canvas.height = height;
      const points = course ? [...course.track.left, ...course.track.right] : [];
      const top = clientHeight > clientWidth ? kListRoomPx : 0;
      this.projection = fit(points, clientWidth, clientHeight, kMargin, top);
      const ground = this.canvas.getContext("2d");
      if (ground && course && width > 0) {
        ground.scale(width / clientWidth, width / clientWidth);
        drawGround(ground, course, this.projection, palette);
      }
    }
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, width, height);
    if (width > 0 && height > 0) pen.drawImage(this.canvas, 0, 0);
    const ratio = clientWidth > 0 ? width / clientWidth : 1;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  }
}

/** Which of the cars of the base is shown; null where it is the only one. */
function amongCars(): { order: number; number: number } | null {
  const { cars, shownCar, hasSeveral } = session;
  if (!hasSeveral.value) return null;
  const { value: car } = shownCar;
  return { order: cars.value.indexOf(car) + 1, number: car.number ?? 0 };
}

function paintMap(canvas: HTMLCanvasElement, ground: Ground, course: Course | null): void {
  const pen = canvas.getContext("2d");
  if (!pen || canvas.clientWidth === 0) return;
  const store = session.fields.value;
  const palette = colours();
  ground.under(pen, course, palette);
  const into = ground.projection;
  const line = lineOffset(store);
  if (course && line !== null) drawLine(pen, course, line, into, palette);
  const car = own(store);
  drawTrail(pen, trail(store), into, palette, car === null || car.quality >= Quality.stale);
  const hollow = ghost(store);
  if (hollow) drawGhost(pen, hollow, into, palette);
  if (course) {
    const [tracked, others] = [rivals(store, course), mates(course)];
    drawRivals(pen, tracked, into, palette);
    drawMates(pen, others, into, palette);
    drawList(pen, tracked, others, palette);
  }
  if (car) drawOwn(pen, car, into, palette, amongCars());
}

function paintStrip(canvas: HTMLCanvasElement, course: Course): void {
  const pen = canvas.getContext("2d");
  if (!pen || canvas.clientWidth === 0) return;
  const ratio = canvas.width / canvas.clientWidth;
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
  const station = { ...readPath("track.station") };
  if (station.quality === Quality.never || !Number.isFinite(station.value)) return;
  drawStrip(
    pen,
    course,
    {
      station: station.value,
      offset: readPath("track.offset").value || 0,
      stale: station.quality >= Quality.stale,
      line: lineOffset(session.fields.value),
      rivals: rivals(session.fields.value, course),
    },
    colours(),
    canvas.clientWidth,
    canvas.clientHeight,
  );
}

export function MapPanel() {
  const map = useRef<HTMLCanvasElement>(null);
  const strip = useRef<HTMLCanvasElement>(null);
  const ground = useRef<Ground | null>(null);
  const track = session.track.value;
  usePainter(
    () => {
      ground.current ??= new Ground();
      const course = track ? new Course(track) : null;
      if (map.current) {
        sizeCanvas(map.current);
        paintMap(map.current, ground.current, course);
      }
      if (strip.current && course) {
        sizeCanvas(strip.current);
        paintStrip(strip.current, course);
      }
    },
    kMapHz,
    [track],
  );
  return (
    <div class="map-body">
      <div class="map-box">
        <canvas ref={map} role="img" aria-label={`map of ${track?.name ?? "the track"}`} />
        <div class="map-caption">
          {track ? track.name : "no track file"}
          <small>
            dashed: not seen for {kCoastsAfterS} s; ring: {kSigmas}&#8239;&sigma;
          </small>
        </div>
      </div>
      <canvas ref={strip} class="strip" role="img" aria-label="the road around the car" />
      <div class="tiles four">
        <Tile label="station" path="track.station" decimals={0} />
        <Tile label="offset" path="track.offset" decimals={2} />
        <Tile label="role" path="planner.role" />
        <Tile label="planner" path="planner.primitive" />
      </div>
    </div>
  );
}
