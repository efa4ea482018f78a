/**
 * Several cars: each has its own connection and its own store, and what the console shows and sends
 * is that of the one that is shown.
 */
// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { CarSession } from "../src/store/car_session";
import { askedCar, placeOf, readCars, showNextCar } from "../src/store/cars";
import * as session from "../src/store/session";
import { isHolder, keepAuthority, lastStop, send, stop, stopAll } from "../src/store/uplink";
import { newcomer } from "../src/frame/tones";
import {
  compared,
  comparedNumber,
  dataOfTime,
  linesOf,
  nameOf,
  valueAt,
} from "../src/pages/plots/lines";
import { History } from "../src/store/history";
import type { Alarm } from "../src/wire/messages";

/** What each socket was told, by its address. */
const sent = new Map<string, string[]>();

class Socket {
  static readonly OPEN = 1;
  static readonly newest = new Map<string, Socket>();
  readyState = Socket.OPEN;
  onopen?: () => void;
  onmessage?: (event: { data: unknown }) => void;
  onclose?: () => void;
  constructor(private readonly url: string) {
    sent.set(url, []);
    Socket.newest.set(url, this);
    queueMicrotask(() => this.onopen?.());
  }
  send(text: string): void {
    sent.get(this.url)!.push(text);
  }
}

const hello = (car: number, client = 16) => ({
  type: "hello",
  version: 1,
  car,
  name: `car ${car}`,
  mode: "HIL",
  role: "operator",
  client,
  alarm_config: "",
  time_ns: 0,
  utc_ms: 0,
});
const alarm = (id: number): Alarm => ({
  id,
  key: "k",
  text: "t",
  response: "r",
  priority: "high",
  state: "unack",
  since_ms: 0,
  count: 1,
  first_up: false,
});

let blue: CarSession;
let red: CarSession;

beforeEach(() => {
  vi.stubGlobal("WebSocket", Socket);
  vi.stubGlobal("location", new URL("http://base:8080/"));
  vi.stubGlobal("history", { replaceState: () => {} });
  sent.clear();
  [blue, red] = [new CarSession(7), new CarSession(8)];
  blue.open("ws://base/ws?car=7");
  red.open("ws://base/ws?car=8");
  session.cars.value = [blue, red];
  session.showCar(blue);
  blue.takeText(hello(7));
  red.takeText(hello(8, 17));
});
afterEach(() => vi.unstubAllGlobals());

describe("the cars of a base", () => {
  test("are read from what is a list of cars, and from nothing else", () => {
    expect(readCars({ cars: [{ number: 7, name: "A" }, { number: 0 }] })).toEqual([
      { number: 7, name: "A" },
      { number: 0, name: "" },
    ]);
    for (const none of [null, 3, [], {}, { cars: {} }, { cars: [null, { number: "7" }, {}] }]) {
      expect(readCars(none)).toEqual([]);
    }
  });

  test("the address names one by its number", () => {
    expect(askedCar("?token=x&car=8")).toBe(8);
    expect(askedCar("?car=0")).toBe(0);
    for (const none of ["", "?car=", "?car=x", "?car=-1", "?car=1e2", "?car=70000"]) {
      expect(askedCar(none)).toBeNull();
    }
    expect(placeOf("api/track", red)).toBe("api/track?car=8");
    expect(placeOf("api/track", new CarSession())).toBe("api/track");
  });
});

describe("the car that is shown", () => {
  test("is the one whose values are read", () => {
    expect(session.hello.value?.car).toBe(7);
    red.takeText({ type: "alarms", active: [alarm(3)] } as never);
    expect(session.alarms.value).toBeNull();
    showNextCar();
    expect(session.hello.value?.car).toBe(8);
    expect(session.alarms.value?.active).toHaveLength(1);
    expect(session.clock).toBe(red.clock);
    expect(session.history).toBe(red.history.value);
    showNextCar();
    expect(session.history).toBe(blue.history.value);
  });

  test("is the only one that is told anything", () => {
    session.showCar(red);
    stop("emergency");
    expect(send({ type: "mark", text: "x" })).toBe(true);
    expect(sent.get("ws://base/ws?car=8")).toHaveLength(2);
    expect(sent.get("ws://base/ws?car=7")).toHaveLength(0);
    expect(lastStop.value).toMatchObject({ kind: "emergency", sent: true });
    session.showCar(blue);
    expect(lastStop.value).toBeNull();
  });

  test("that the base no longer has gives way to the first", () => {
    session.showCar(red);
    session.cars.value = [blue];
    expect(session.shownCar.value).toBe(blue);
    expect(session.hasSeveral.value).toBe(false);
  });
});

describe("a stop of all cars", () => {
  test("is told to each on its own connection, whichever is shown", () => {
    for (const shown of [blue, red]) {
      session.showCar(shown);
      stopAll();
    }
    const one = '{"type":"stop","kind":"controlled"}';
    expect(sent.get("ws://base/ws?car=7")).toEqual([one, one]);
    expect(sent.get("ws://base/ws?car=8")).toEqual([one, one]);
    expect(lastStop.value).toMatchObject({ kind: "controlled", sent: true });
  });

  test("reaches the others where one has no connection, and each knows whether it was sent", () => {
    Socket.newest.get("ws://base/ws?car=7")!.readyState = 3;
    stopAll();
    expect(blue.lastStop.value?.sent).toBe(false);
    expect(red.lastStop.value?.sent).toBe(true);
    expect(sent.get("ws://base/ws?car=8")).toHaveLength(1);
  });
});

describe("the car that is not shown", () => {
  test("keeps its authority", () => {
    vi.useFakeTimers();
    const authority = {
      type: "authority",
      holder_name: "",
      epoch: 1,
      expires_ms: 1,
      request: null,
    };
    red.takeText({ ...authority, holder: 17 } as never);
    blue.takeText({ ...authority, holder: 17 } as never);
    expect(isHolder.value).toBe(false);
    keepAuthority();
    vi.advanceTimersByTime(1000);
    vi.useRealTimers();
    expect(sent.get("ws://base/ws?car=8")).toEqual(['{"type":"authority","do":"renew"}']);
    expect(sent.get("ws://base/ws?car=7")).toEqual([]);
  });

  test("keeps the numbers of its alarms apart", () => {
    expect(newcomer(new Set([3]), [alarm(3)])).toBeNull();
    expect(newcomer(new Set(), [alarm(3)])).toBe("high");
  });
});

describe("another car in the same chart", () => {
  const spec = { title: "speed", fields: ["ego.vx", "ego.vy"] };
  const info = spec.fields.map((path, id) => ({
    id,
    path,
    group: "ego",
    name: path.slice(4),
    title: path === "ego.vx" ? "speed" : "lateral speed",
    unit: "m/s",
    kind: "real",
    min: 0,
    max: 1,
    resolution: 0.1,
    period_ms: 100,
  }));
  /** Rows of a car that has the speed `vx` at these moments. */
  const drive = (car: CarSession, vx: number, timesMs: readonly number[]) => {
    car.takeCatalogue({ fields: info, commands: [], race: { attempt_laps: 2, pass_gap_m: 30 } });
    car.history.value = new History(2, 64);
    for (const at of timesMs) {
      car.fields.value.write(0, 0, 0, vx, at);
      car.fields.value.write(1, 0, 0, -vx, at);
      car.history.value.append(car.fields.value, at);
    }
  };

  beforeEach(() => {
    comparedNumber.value = null;
    drive(blue, 50, [1000, 1040, 1080]);
    drive(red, 60, [1010, 1050]);
  });

  test("has a line of its own beside each field", () => {
    expect(linesOf(spec, "time").map(nameOf)).toEqual(["speed", "lateral speed"]);
    comparedNumber.value = 8;
    const names = ["speed", "car 8", "lateral speed", "car 8"];
    expect(linesOf(spec, "time").map(nameOf)).toEqual(names);
    expect(linesOf(spec, "distance").map(nameOf)).toEqual(names);
  });

  test("stands on the same axis, and neither makes gaps in the other", () => {
    comparedNumber.value = 8;
    const [timeS, own, other, , otherVy] = dataOfTime(spec, 1000, 1080, 1000);
    expect(timeS).toEqual([1, 1.01, 1.04, 1.05, 1.08]);
    expect(own).toEqual([50, undefined, 50, undefined, 50]);
    expect(other).toEqual([undefined, 60, undefined, 60, undefined]);
    expect(otherVy?.[1]).toBe(-60);
    expect(valueAt(own, 3)).toBe(50);
    expect(valueAt(other, 0)).toBeNull();
    expect(valueAt([50, null, undefined], 2)).toBeNull();
  });

  test("is never the one that is shown, and none that is not here", () => {
    comparedNumber.value = 7;
    expect(compared.value).toBeNull();
    comparedNumber.value = 9;
    expect(compared.value).toBeNull();
    comparedNumber.value = 8;
    session.showCar(red);
    expect(compared.value).toBeNull();
    expect(dataOfTime(spec, 1000, 1080, 1000)[0]).toEqual([1.01, 1.05]);
  });
});

describe("the time of a bench", () => {
  afterEach(() => vi.useRealTimers());

  test("is that of its base, and the next base lives by its own", () => {
    vi.useFakeTimers(); // the socket would come back
    expect(session.benchTime.value).toBeNull();
    blue.takeText(
      { type: "bench_time", time_ms: 1000, stands_ms: 200, stood_ms: 700 } as never,
      50,
    );
    expect(session.benchTime.value?.stood_ms).toBe(700);
    expect(session.clock.pauseMs(60)).toBe(210);
    expect(red.clock.pauseMs(60)).toBeNull();
    Socket.newest.get("ws://base/ws?car=7")!.onclose?.();
    expect(session.benchTime.value).toBeNull();
    expect(session.clock.pauseMs(60)).toBeNull();
  });
});
