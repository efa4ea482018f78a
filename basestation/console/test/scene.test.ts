/**
 * What the map places where: a car that was not heard lately keeps its last place and says that it
 * is old; what the base only reckons, and the line, go where nobody knows them any more.
 */
// SPDX-License-Identifier: Apache-2.0
import { afterEach, describe, expect, test } from "vitest";
import { kTrack } from "../../../tests/system/console/drive.mjs";
import { ageCode } from "../../../tests/system/console/wire.mjs";
import { Course } from "../src/map/course";
import {
  ghost,
  kForgottenMs,
  kSigmas,
  lineOffset,
  mates,
  own,
  rivals,
  trail,
} from "../src/map/scene";
import { CarSession } from "../src/store/car_session";
import { Fields } from "../src/store/fields";
import { History } from "../src/store/history";
import * as session from "../src/store/session";
import { beginFrame } from "../src/view/timeline";
import type { FieldInfo } from "../src/wire/messages";
import { Judgement, Quality } from "../src/wire/status";

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
  "opponent_1.age": 0.1,
  "opponent_1.position_sigma": 0.4,
};
const course = new Course(kTrack as never);

/** Everything heard with this quality, in a console that hears its base or not. */
function heard(quality: Quality, silent = false, values = kValues): Fields {
  const paths = Object.keys(values);
  const fields = new Fields(
    paths.map((path, id): FieldInfo => {
      const [group, name] = path.split(".");
      const range = { min: -1e6, max: 1e6, resolution: 0.1, period_ms: 100 };
      return { id, path, group, name, title: path, unit: "", kind: "real", ...range };
    }),
  );
  paths.forEach((path, id) => fields.write(id, quality, 0, values[path], 1000));
  session.fields.value = fields;
  session.clock.received(1000, 5000);
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

test("a rival of which the car says nothing more goes, and stays when the car is silent", () => {
  const rivalsWhen = (rivalMs: number, ownMs: number) => {
    const fields = heard(Quality.stale);
    for (const { id, path } of fields.info) {
      const [group] = path.split(".");
      const ageMs = group === "opponent_1" ? rivalMs : ownMs;
      fields.write(
        id,
        ageMs > 1000 ? Quality.stale : Quality.fresh,
        ageCode(ageMs),
        kValues[path],
        1000,
      );
    }
    return rivals(fields, course).map(({ identity, stale }) => [identity, stale]);
  };
  expect(rivalsWhen(100, 100)).toEqual([[7, false]]);
  expect(rivalsWhen(9_000, 100)).toEqual([[7, true]]);
  expect(rivalsWhen(kForgottenMs + 2_000, 100)).toEqual([]);
  expect(rivalsWhen(60_000, 60_000)).toEqual([[7, true]]);
});

test("nothing that was never heard is placed", () => {
  const fields = heard(Quality.never);
  expect(own(fields)).toBeNull();
  expect(ghost(fields)).toBeNull();
  expect(lineOffset(fields)).toBeNull();
  expect(rivals(fields, course)).toEqual([]);
});

test("what is not a number is not placed, and an angle that is none points east", () => {
  for (const broken of ["ego.x", "ego.y"])
    expect(own(heard(Quality.fresh, false, { ...kValues, [broken]: NaN }))).toBeNull();
  for (const broken of ["derived.ghost_x", "derived.ghost_y"])
    expect(ghost(heard(Quality.fresh, false, { ...kValues, [broken]: NaN }))).toBeNull();
  expect(
    lineOffset(heard(Quality.fresh, false, { ...kValues, "planner.line_offset": NaN })),
  ).toBeNull();
  const turned = {
    ...kValues,
    "ego.yaw": NaN,
    "derived.ghost_yaw": NaN,
    "derived.ghost_radius": NaN,
  };
  const fields = heard(Quality.fresh, false, turned);
  expect(own(fields)).toMatchObject({ yaw: 0 });
  expect(ghost(fields)).toMatchObject({ yaw: 0, radius: 0 });
});

test("up to four rivals are placed, those that have an identity and a station", () => {
  const several: Record<string, number> = { ...kValues };
  for (const n of [2, 3, 4, 5]) {
    several[`opponent_${n}.identity`] = n - 1;
    several[`opponent_${n}.station`] = 100 - 10 * n;
    several[`opponent_${n}.offset`] = n === 2 ? NaN : n;
    several[`opponent_${n}.speed`] = 40;
  }
  const found = rivals(heard(Quality.fresh, false, several), course);
  expect(found.map(({ identity }) => identity)).toEqual([7, 1, 2, 3]);
  expect(found.map(({ station }) => station)).toEqual([140, 80, 70, 60]);
  expect(found.map(({ offset }) => offset)).toEqual([-1, 0, 3, 4]);
  expect(found.map(({ gap }) => gap)).toEqual([40, -20, -30, -40]);
  expect(found.map(({ closing }) => closing)).toEqual([5, -10, -10, -10]);
  found.forEach((rival) => expect(rival).toMatchObject(course.place(rival.station, rival.offset)));
  several["opponent_2.identity"] = 0;
  several["opponent_3.station"] = NaN;
  const fewer = rivals(heard(Quality.fresh, false, several), course);
  expect(fewer.map(({ identity }) => identity)).toEqual([7, 3]);
});

test("a rival has its speed, its circle, and coasts once no detection confirms it", () => {
  const rivalAt = (age: number, sigma = 0.4) =>
    rivals(
      heard(Quality.fresh, false, {
        ...kValues,
        "opponent_1.age": age,
        "opponent_1.position_sigma": sigma,
      }),
      course,
    )[0];
  expect(rivalAt(0.25)).toMatchObject({ speed: 55, seenS: 0.25, coasts: false });
  expect(rivalAt(0.25).radius).toBeCloseTo(kSigmas * 0.4, 6);
  expect(rivalAt(0.5).coasts).toBe(false);
  expect(rivalAt(0.75).coasts).toBe(true);
  expect(rivalAt(NaN, NaN)).toMatchObject({ coasts: false, radius: 0 });
});

describe("the other cars of the base", () => {
  const kTold = { "ego.x": 30, "ego.y": 40, "ego.yaw": 1, "ego.vx": 61, "track.station": 160 };
  /** Two cars on the track, of which the other told this at 1000 ms. */
  function together(told: Record<string, number> = kTold, track = kTrack.name): CarSession {
    const [here, other] = [session.shownCar.value, new CarSession(8)];
    here.number = 7;
    session.cars.value = [here, other];
    const paths = Object.keys(told);
    const info = paths.map((path, id): FieldInfo => {
      const [group, name] = path.split(".");
      const range = { min: -1e6, max: 1e6, resolution: 0.1, period_ms: 100 };
      return { id, path, group, name, title: path, unit: "", kind: "real", ...range };
    });
    other.takeCatalogue({ fields: info, commands: [], race: null } as never);
    other.history.value = new History(paths.length, 16);
    paths.forEach((path, id) => other.fields.value.write(id, Quality.fresh, 0, told[path], 1000));
    other.history.value.append(other.fields.value, 1000);
    other.track.value = { ...kTrack, name: track } as never;
    other.connected.value = true;
    other.clock.received(1000, performance.now());
    const fields = heard(Quality.fresh);
    here.track.value = kTrack as never;
    here.history.value = new History(fields.info.length, 16);
    here.history.value.append(fields, 1000);
    return other;
  }
  afterEach(() => (session.cars.value = [session.shownCar.value]));

  test("are where they told, with number, gap and speed, without the one that is shown", () => {
    together();
    expect(mates(course)).toEqual([
      { x: 30, y: 40, yaw: 1, number: 8, order: 2, gap: 60, speed: 61, stale: false },
    ]);
  });

  test("are old once their base or they themselves are silent", () => {
    const other = together();
    other.clock.received(1000, performance.now() - 60_000);
    expect(mates(course)[0].stale).toBe(true);
    together().connected.value = false;
    expect(mates(course)[0].stale).toBe(true);
  });

  test("are on the road where they have no pose", () => {
    together({ ...kTold, "ego.x": NaN, "track.offset": 2 });
    expect(mates(course)[0]).toMatchObject(course.place(160, 2));
  });

  test("are not on the map of another track, nor without a place", () => {
    together(kTold, "elsewhere");
    expect(mates(course)).toEqual([]);
    together({ ...kTold, "track.station": NaN });
    expect(mates(course)).toEqual([]);
    together({ "ego.vx": 61 });
    expect(mates(course)).toEqual([]);
  });
});

describe("the trail", () => {
  const field = (id: number, path: string): FieldInfo => {
    const [group, name] = path.split(".");
    const range = { min: -1e6, max: 1e6, resolution: 0.1, period_ms: 100 };
    return { id, path, group, name, title: path, unit: "", kind: "real", ...range };
  };
  const kPaths = ["dynamics.lateral_error", "ego.y", "ego.x"];
  /** `count` rows, x their number; every seventh is stale, the error is a warning. */
  function driven(count: number, paths = kPaths, stepMs = 40, lateMs = 0) {
    const fields = new Fields(paths.map((path, id) => field(id, path)));
    const history = new History(paths.length, 4096);
    session.shownCar.value.history.value = history;
    for (let n = 0; n < count; ++n) {
      paths.forEach((path, id) => {
        const quality = path === "ego.x" && n % 7 === 3 ? Quality.stale : Quality.late;
        const judgement = path === kPaths[0] ? Judgement.warning : Judgement.none;
        const value = path === "ego.y" ? -n : n;
        fields.write(id, quality | (judgement << 2), 0, value, stepMs * n);
      });
      history.append(fields, stepMs * n);
    }
    session.fields.value = fields;
    session.clock.received(stepMs * (count - 1), 5000);
    beginFrame(5000 + lateMs, 16);
    return trail(fields);
  }

  test("is the way just driven, oldest first, without what was stale", () => {
    const points = driven(10);
    expect(points.map(({ x }) => x)).toEqual([0, 1, 2, 4, 5, 6, 7, 8, 9]);
    expect(points.map(({ y }) => y)).toEqual([-0, -1, -2, -4, -5, -6, -7, -8, -9]);
    for (const { judgement } of points) expect(judgement).toBe(Judgement.warning);
  });

  test("begins with the row that was shown twelve seconds ago", () => {
    expect(driven(101, kPaths, 200, 199.5).at(0)!.x).toBe(40);
    expect(driven(101, kPaths, 200, 200.5).at(0)!.x).toBe(41);
  });

  test("leaves out rows only where there are two hundred of them", () => {
    const xs = driven(400, kPaths, 60.5).map(({ x }) => x);
    expect(xs.at(-1)).toBe(399);
    expect(xs.at(-2)).toBe(398);
  });

  test("goes back twelve seconds in about a hundred points that stay where they are", () => {
    const earlier = driven(1000);
    const later = driven(1001);
    for (const points of [earlier, later]) {
      expect(points.length).toBeGreaterThan(30);
      expect(points.length).toBeLessThanOrEqual(101);
    }
    expect(earlier.at(0)!.x).toBeGreaterThanOrEqual(999 - 300 - 3);
    expect(earlier.at(0)!.x).toBeLessThanOrEqual(999 - 300 + 3);
    const shared = later.filter(({ x }) => earlier.some((point) => point.x === x));
    expect(shared.length).toBeGreaterThan(later.length - 3);
  });

  test("has no judgement where the base has no such field, and no way without a place", () => {
    const [point] = driven(5, ["ego.y", "ego.x"]);
    expect(driven(5, ["ego.x", "ego.y"])).toEqual(driven(5, ["ego.y", "ego.x"]));
    expect(point.judgement).toBe(Judgement.none);
    expect(driven(5, ["ego.x"])).toEqual([]);
    expect(driven(5, ["ego.y"])).toEqual([]);
    expect(driven(0)).toEqual([]);
  });
});
