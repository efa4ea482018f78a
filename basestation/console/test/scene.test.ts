/**
 * What the map places where: a car that was not heard lately keeps its last place and says that it
 * is old; what the base only reckons, and the line, go where nobody knows them any more.
 */
// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { kTrack } from "../../../tests/system/console/drive.mjs";
import { Course } from "../src/map/course";
import { ghost, lineOffset, own, rivals } from "../src/map/scene";
import { Fields } from "../src/store/fields";
import * as session from "../src/store/session";
import { beginFrame } from "../src/view/timeline";
import type { FieldInfo } from "../src/wire/messages";
import { Quality } from "../src/wire/status";

const kValues: Record<string, number> = {
  "ego.x": 10,
  "ego.y": 20,
  "ego.yaw": 0.5,
  "ego.vx": 50,
  "track.station": 100,
  "planner.line_offset": 2,
  "derived.ghost_x": 11,
  "derived.ghost_y": 21,
  "derived.ghost_yaw": 0.5,
  "derived.ghost_radius": 4,
  "opponent_1.identity": 7,
  "opponent_1.station": 140,
  "opponent_1.offset": -1,
  "opponent_1.speed": 55,
};
const course = new Course(kTrack as never);

/** Everything heard with this quality, in a console that hears its base or not. */
function heard(quality: Quality, silent = false): Fields {
  const paths = Object.keys(kValues);
  const fields = new Fields(
    paths.map((path, id): FieldInfo => {
      const [group, name] = path.split(".");
      const range = { min: -1e6, max: 1e6, resolution: 0.1, period_ms: 100 };
      return { id, path, group, name, unit: "", kind: "real", ...range };
    }),
  );
  paths.forEach((path, id) => fields.write(id, quality, 0, kValues[path], 1000));
  session.fields.value = fields;
  session.clock.heard(1000, 5000);
  beginFrame(silent ? 6000 : 5010, 16);
  return fields;
}

test.each([
  [Quality.fresh, false],
  [Quality.late, false],
  [Quality.stale, false],
  [Quality.fresh, true],
])("quality %i, base silent: %s", (quality, silent) => {
  const fields = heard(quality, silent);
  const old = silent || quality === Quality.stale;
  expect(own(fields)).toMatchObject({ x: 10, y: 20, yaw: 0.5 });
  expect(own(fields)!.quality).toBe(old ? Quality.stale : quality);
  expect(ghost(fields)).toEqual(old ? null : { x: 11, y: 21, yaw: 0.5, radius: 4 });
  expect(lineOffset(fields)).toBe(old ? null : 2);
  const [rival, ...more] = rivals(fields, course);
  expect(more).toEqual([]);
  expect(rival).toMatchObject({ identity: 7, closing: 5, stale: old });
});

test("nothing that was never heard is placed", () => {
  const fields = heard(Quality.never);
  expect(own(fields)).toBeNull();
  expect(ghost(fields)).toBeNull();
  expect(lineOffset(fields)).toBeNull();
  expect(rivals(fields, course)).toEqual([]);
});
