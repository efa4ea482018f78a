/**
 * The test double of the base: serves the built console under the strict content policy and speaks
 * PROTOCOL.md with a scripted drive. What the console sends is kept for the test to read.
 *
 *   node double.mjs PORT   serves until it is ended, to look at the console by hand
 */
// SPDX-License-Identifier: Apache-2.0
import { execFileSync } from "node:child_process";
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import { kRoot, WebSocketServer } from "./packages.mjs";
import { kTrack, valuesAt } from "./drive.mjs";
import * as wire from "./wire.mjs";

const kDist = join(kRoot, "build/console/dist");
const kProgram = join(kRoot, "build/release/basestation/pitwall-base");
const kTypes = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".woff2": "font/woff2",
};
const kBaseFields = {
  link: {
    state: ["", ["none", "good", "degraded", "lost"]],
    silence_ms: ["ms"],
    down_loss: [""],
    up_loss: [""],
    rtt_ms: ["ms"],
    jitter_ms: ["ms"],
    down_kbit_s: ["kbit/s"],
    down_cap_kbit_s: ["kbit/s"],
    up_kbit_s: ["kbit/s"],
    worst_age_ms: ["ms"],
    stale_groups: [""],
  },
  derived: {
    tyre_min: ["degC"],
    tyre_gate: ["degC"],
    slip: [""],
    fuel_per_lap: ["l"],
    fuel_laps: [""],
    fuel_attempts: [""],
    fuel_level: ["l"],
    fuel_least: ["l"],
    fuel_least_laps: [""],
    ghost_x: ["m"],
    ghost_y: ["m"],
    ghost_yaw: ["rad"],
    ghost_radius: ["m"],
    slip_rear_front: [""],
    slip_rear_gnss: [""],
    flag_conflict: ["", ["no", "yes"]],
    round_speed_conflict: ["", ["no", "yes"]],
    race_control_speed: ["m/s"],
    round_speed_expected: ["m/s"],
    fuel_state: ["", ["unknown", "enough", "no attempt left", "home now"]],
    flag_relayed: [
      "",
      ["none", "RED", "ORANGE", "YELLOW", "GREEN", "WAVING GREEN", "CHEQUERED", "UNKNOWN"],
    ],
    role: ["", ["none", "defender", "attacker"]],
    role_conflict: ["", ["no", "yes"]],
    attempt: [""],
    attempt_state: ["", ["none", "running", "laps used up", "PASSED", "ended"]],
    attempt_laps: [""],
    attempt_laps_left: [""],
    gap_ahead: ["m"],
    gap_behind: ["m"],
    gap_closing: ["m/s"],
  },
};
const kFirstBaseField = 16_384;
/** By which each car drives behind the one before it. */
const kBehindS = 3;

/** The catalogue as a base would serve it: the registry out of the real program, and its own. */
export function catalogue(program = process.env.PITWALL_BASE ?? kProgram) {
  const registry = JSON.parse(execFileSync(program, ["export", "json"], { maxBuffer: 1 << 24 }));
  const fields = [];
  let id = 0;
  for (const group of registry.groups) {
    for (const field of group.fields) {
      const at = id++;
      if (group.direction !== "down") continue;
      fields.push({
        id: at,
        path: field.path,
        group: group.name,
        name: field.name,
        title: field.title,
        unit: field.unit,
        kind: field.kind,
        min: field.min,
        max: field.max,
        resolution: field.resolution,
        labels: field.labels ?? null,
        period_ms: group.target_age_ms,
        limits: null,
      });
    }
  }
  let own = kFirstBaseField;
  for (const [group, rows] of Object.entries(kBaseFields)) {
    for (const [name, [unit, labels]] of Object.entries(rows)) {
      fields.push({
        id: own++,
        path: `${group}.${name}`,
        group,
        name,
        title: `${group} ${name}`.replaceAll("_", " "),
        unit,
        kind: labels ? "integer" : "real",
        min: 0,
        max: 1e6,
        resolution: 0.001,
        labels: labels ?? null,
        period_ms: 100,
        limits: null,
      });
    }
  }
  return { fields, commands: registry.commands, race: { attempt_laps: 2, pass_gap_m: 30 } };
}

export class Double {
  /** What consoles sent, in order. */
  received = [];
  /** Number of the newest mark behind messages of a page: see `arrived` of the stage. */
  mark = 0;
  /** Fields set by the test: path -> {value, quality, judgement} over the script. */
  overrides = new Map();
  /** False: the car is silent, ages grow, every field becomes stale in its time. */
  carAlive = true;
  /** How often it sends; as a base does, unless a test looks at what is drawn alone. */
  framesPerSecond = 25;
  /** What it says once a second of the check list, and what it has recorded; null: nothing. */
  checklist = null;
  recordings = null;
  /** What the consoles are told that they lost. */
  dropped = 0;
  layouts = new Map();
  /** What /api/cars says; empty: a base of one car that says nothing of it. */
  cars = [];
  hello = {
    type: "hello",
    version: 1,
    car: 7,
    name: "Caracara",
    mode: "HIL",
    role: "operator",
    client: 16,
    second_person: true,
    alarm_config: "3f2a",
    time_ns: 0,
    utc_ms: 0,
  };

  constructor(known = catalogue()) {
    this.catalogue = known;
    this.streams = known.fields.filter((f) => f.group === "streams").map((f) => f.path);
    this.started = performance.now();
    this.silentSince = NaN;
    this.sequence = 0;
    this.frameListeners = [];
  }

  /** Starts on a port of its own (or the given one) and resolves with its address. */
  async listen(port = 0) {
    this.server = createServer((request, response) => this.serve(request, response));
    this.sockets = new WebSocketServer({ server: this.server, path: "/ws" });
    this.sockets.on("connection", (socket, request) => this.greet(socket, request));
    await new Promise((done) => this.server.listen(port, "127.0.0.1", done));
    this.timer = setInterval(() => this.tick(), 1000 / this.framesPerSecond);
    return `http://127.0.0.1:${this.server.address().port}`;
  }

  async close() {
    clearInterval(this.timer);
    for (const socket of this.sockets.clients) socket.terminate();
    this.server.closeAllConnections();
    await new Promise((done) => this.server.close(done));
  }

  silence() {
    this.carAlive = false;
    this.silentSince = this.nowMs();
  }

  nowMs() {
    return 100_000 + performance.now() - this.started;
  }

  say(message) {
    for (const socket of this.sockets.clients) socket.send(JSON.stringify(message));
  }

  set(path, value, judgement = 0, quality = wire.kFresh) {
    this.overrides.set(path, { value, judgement, quality });
  }

  entries(car = 0) {
    const silentMs = this.carAlive ? 0 : this.nowMs() - this.silentSince;
    const drivenS = (this.nowMs() - silentMs) / 1000 - 80 - kBehindS * car;
    const values = valuesAt(drivenS, this.streams);
    return this.catalogue.fields.map((field) => {
      const own = this.overrides.get(field.path);
      const value = own?.value ?? values[field.path];
      if (value === undefined) {
        return {
          id: field.id,
          status: wire.statusByte(wire.kNever),
          age: 255,
          value: NaN,
        };
      }
      const age = silentMs + (own?.quality === wire.kStale ? 6 * field.period_ms : 20);
      const quality = own?.quality || this.qualityAt(age, field.period_ms);
      const judged = own?.judgement || (field.group === "streams" ? wire.kGood : 0);
      return {
        id: field.id,
        value,
        age: wire.ageCode(age),
        status: wire.statusByte(quality, judged),
      };
    });
  }

  /** FRESH up to 1.5 periods, LATE up to 5, STALE after that or after 2 s. */
  qualityAt(ageMs, periodMs) {
    if (ageMs > Math.min(5 * periodMs, Math.max(2000, 1.5 * periodMs))) return wire.kStale;
    return ageMs > 1.5 * periodMs ? wire.kLate : wire.kFresh;
  }

  tick() {
    const head = { sequence: ++this.sequence, dropped: this.dropped, timeMs: this.nowMs() };
    const frames = [];
    for (const socket of this.sockets.clients) {
      const car = socket.car ?? 0;
      socket.send((frames[car] ??= wire.snapshot(this.entries(car), head)));
    }
    if (this.checklist && this.sequence % this.framesPerSecond === 0) {
      this.say(this.checklist(this.nowMs()));
    }
    for (const listener of this.frameListeners) listener(this.nowMs());
  }

  /** Every car of the double drives the same drive, one behind the other. */
  greet(socket, request) {
    const asked = new URL(request.url, "http://localhost").searchParams.get("car");
    const car = this.cars.find(({ number }) => String(number) === asked) ?? this.cars[0];
    socket.car = Math.max(this.cars.indexOf(car), 0);
    const texts = [
      {
        ...this.hello,
        ...(car ? { car: car.number, name: car.name } : {}),
        time_ns: this.nowMs() * 1e6,
        utc_ms: Date.UTC(2026, 0, 9, 19, 4, 12),
      },
      { type: "catalogue", ...this.catalogue },
      ...(this.greetings ?? []),
    ];
    for (const text of texts) socket.send(JSON.stringify(text));
    socket.send(wire.snapshot(this.entries(socket.car), { timeMs: this.nowMs() }));
    socket.on("message", (data) => this.take(socket, JSON.parse(String(data))));
  }

  take(socket, message) {
    if (message.type === "mark of the test") return (this.mark = message.n);
    this.received.push(message);
    if (message.type === "history") {
      const points = Array.from({ length: 50 }, (_, i) => ({
        timeS: this.nowMs() / 1000 - 60 + i,
        value: 60 + Math.sin(i / 4),
        quality: wire.kFresh,
      }));
      socket.send(wire.history(message.field, points, { timeMs: this.nowMs() }));
    }
    if (message.type === "lap") {
      socket.send(wire.lap(message.lap, this.laps[message.lap], { timeMs: this.nowMs() }));
    }
    this.answers?.(message, (answer) => this.say(answer));
  }

  async serve(request, response) {
    const path = new URL(request.url, "http://localhost").pathname;
    response.setHeader("Content-Security-Policy", "default-src 'self'");
    const json = (value) => {
      response.setHeader("Content-Type", "application/json");
      response.end(JSON.stringify(value));
    };
    if (path === "/api/catalogue") return json(this.catalogue);
    if (path === "/api/track") return json(kTrack);
    if (path === "/api/session")
      return json({ role: this.role ?? "operator", name: "", logged_in: false });
    if (path === "/api/cars") return json({ cars: this.cars });
    if (path === "/api/recordings" && this.recordings) return json(this.recordings);
    if (path === "/api/recordings") return response.writeHead(204).end();
    if (path.startsWith("/api/layouts/")) return this.serveLayout(request, response, path);
    const file = path === "/" ? "index.html" : normalize(path).replace(/^[/.]+/, "");
    try {
      const bytes = await readFile(join(kDist, file));
      response.setHeader("Content-Type", kTypes[extname(file)] ?? "application/octet-stream");
      response.end(bytes);
    } catch {
      response.writeHead(404).end("not found\n");
    }
  }

  serveLayout(request, response, path) {
    if (request.method === "PUT") {
      let text = "";
      request.on("data", (part) => (text += part));
      request.on("end", () => {
        this.layouts.set(path, text);
        response.writeHead(204).end();
      });
      return;
    }
    const layout = this.layouts.get(path);
    if (layout === undefined) response.writeHead(204).end();
    else response.end(layout);
  }
}

if (process.argv[1] === new URL(import.meta.url).pathname) {
  const double = new Double();
  const { checklist, greetings, kRecordings } = await import("./story.mjs");
  double.greetings = greetings(double);
  Object.assign(double, { checklist, recordings: kRecordings });
  console.log(await double.listen(Number(process.argv[2] ?? 8090)));
}
