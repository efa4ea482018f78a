// Foxglove's own client on a Foxglove WebSocket server: foxglove_client.mjs live|replay ADDRESS, or
// of one of several cars, whose topics begin with SPACE and which is that fast:
// foxglove_client.mjs space ADDRESS SPACE SPEED; or of a car of the bench, whatever it does:
// foxglove_client.mjs bench ADDRESS.
// Ends with 1 and says why where something is not as the protocol has it.
// SPDX-License-Identifier: Apache-2.0
import library from "@foxglove/ws-protocol";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { WebSocket } from "ws";

const { FoxgloveClient } = library;
const kPatienceMs = 15_000;
const kProtocols = ["foxglove.websocket.v1", "foxglove.sdk.v1"];
const [mode, address, space, speed] = process.argv.slice(2);

function expect(condition, what) {
  if (condition) return;
  console.log(`FAILED: ${what}`);
  process.exit(1);
}

async function until(what, test) {
  const end = Date.now() + kPatienceMs;
  for (;;) {
    const found = test();
    if (found) return found;
    expect(Date.now() < end, `waited in vain for ${what}`);
    await new Promise((done) => setTimeout(done, 5));
  }
}

/** A client with all that it was told. */
class Viewer {
  statuses = [];
  times = [];
  messages = new Map();
  states = [];
  closed = undefined;

  static async open(protocol) {
    const viewer = new Viewer();
    viewer.socket = new WebSocket(address, [protocol]);
    viewer.socket.on("message", (data, isBinary) => isBinary && viewer.#note(Buffer.from(data)));
    viewer.socket.on("close", (code) => (viewer.closed = code));
    const client = (viewer.client = new FoxgloveClient({ ws: viewer.socket }));
    client.on("serverInfo", (info) => (viewer.info = info));
    client.on("advertise", (channels) => (viewer.channels = channels));
    client.on("status", (status) => viewer.statuses.push(status));
    client.on("time", ({ timestamp }) => viewer.times.push(timestamp));
    client.on("message", (message) => viewer.#take(message));
    client.on("error", (error) => viewer.#refuse(error));
    await until("serverInfo and channels", () => viewer.info && viewer.channels);
    const chosen = viewer.socket.protocol;
    expect(chosen === protocol, `${protocol} is chosen, not ${chosen}`);
    return viewer;
  }

  // The library is older than the playback's opcode.
  #refuse(error) {
    const known = /opcode/.test(String(error)) && this.states.length > 0;
    expect(known, `the client understands: ${error}`);
  }

  /** PlaybackState: u8 5 | u8 status | u64 ns | f32 speed | u8 did seek | u32 n | request id. */
  #note(bytes) {
    if (bytes[0] !== 5) return;
    this.states.push({
      status: bytes[1],
      ns: bytes.readBigUInt64LE(2),
      speed: bytes.readFloatLE(10),
      didSeek: bytes[14] === 1,
      request: bytes.subarray(19, 19 + bytes.readUInt32LE(15)).toString(),
    });
  }

  #take({ subscriptionId, timestamp, data }) {
    const topic = this.topics.get(subscriptionId);
    const value = this.readers.get(topic)(data);
    this.messages.set(topic, { value, timestamp });
  }

  subscribe(wanted = () => true) {
    this.topics = new Map();
    this.readers = new Map();
    for (const { id, topic, encoding, schemaEncoding, schema } of this.channels) {
      if (!wanted(topic)) continue;
      this.readers.set(topic, readerOf(encoding, schemaEncoding, schema));
      this.topics.set(this.client.subscribe(id), topic);
    }
  }

  refusal(pattern) {
    return until(`a refusal that says ${pattern}`, () =>
      this.statuses.find(({ level, message }) => level === 2 && pattern.test(message)),
    );
  }
}

function readerOf(encoding, schemaEncoding, schema) {
  if (encoding === "json") {
    return (data) => JSON.parse(Buffer.from(data.buffer, data.byteOffset, data.byteLength));
  }
  expect(encoding === "cdr" && schemaEncoding === "ros2msg", `${encoding} of ${schemaEncoding}`);
  const reader = new MessageReader(parse(schema, { ros2: true }));
  return (data) => reader.readMessage(data);
}

function wrongProtocol(protocols) {
  return new Promise((done) => {
    const socket = new WebSocket(address, protocols);
    socket.on("unexpected-response", (_, { statusCode }) => done(statusCode));
    socket.on("open", () => done("opened"));
    socket.on("error", () => {});
  });
}

/** Of four opponents the first is known: a cube, an arrow, a disk and a text. */
function opponentsAreDrawn(markers) {
  expect(markers.length === 16, `${markers.length} markers`);
  const known = markers.filter(({ action }) => action === 0);
  expect(known.map(({ type }) => type).join() === "1,0,3,9", `types ${known.map((m) => m.type)}`);
  const [box, arrow, disk, text] = known;
  expect(box.header.frame_id === "map", `frame ${box.header.frame_id}`);
  expect(Math.abs(arrow.scale.x - 40) < 0.1, `an arrow of ${arrow.scale.x} m`);
  expect(Math.abs(disk.scale.x - 2) < 0.1, `a disk of ${disk.scale.x} m`);
  expect(text.text === "3: 40.0 m/s", `the text ${text.text}`);
}

async function whatTheCarSays(viewer) {
  viewer.subscribe();
  const topics = ["/car/ego", "/car/mode", "/car/tyres", "/base/hello", "/base/link"];
  for (const topic of [...topics, "/diagnostics", "/base/values/link", "/raceline"]) {
    await until(topic, () => viewer.messages.get(topic));
  }
  const ego = viewer.messages.get("/car/ego").value;
  expect(Math.abs(ego.vx - 50.5) < 0.1, `a speed of ${ego.vx}`);
  expect(Math.abs(ego.x - 12.5) < 0.1, `a place of ${ego.x}`);
  expect(Number.isNaN(ego.y), "what the car does not know is NaN");
  const off = Number(viewer.messages.get("/car/ego").timestamp) / 1e6 - Date.now();
  expect(Math.abs(off) < 5000, `messages have the time of now, not ${off} ms off`);
  expect(viewer.messages.get("/raceline").value.poses.length > 100, "the race line is latched");
  const markers = await until("the opponents", () => viewer.messages.get("/opponents"));
  opponentsAreDrawn(markers.value.markers);
  await until("the server's time", () => viewer.times.length > 2);
  expect(viewer.messages.get("/base/hello").value.mode === "HIL", "it is told as a simulation");
}

async function thresholdsAreRead(viewer) {
  const { client } = viewer;
  let answer;
  client.on("parameterValues", (told) => (answer = told));
  client.getParameters([], "all");
  const { id, parameters } = await until("parameters", () => answer);
  expect(id === "all" && parameters.length > 50, `${parameters.length} parameters for ${id}`);
  const numbers = parameters.every(
    ({ name, value }) => name.startsWith("/alarms/") && Number.isFinite(value),
  );
  expect(numbers, "each is a number of an alarm");
  let graph;
  client.on("connectionGraphUpdate", (told) => (graph = told));
  client.subscribeConnectionGraph();
  const { publishedTopics } = await until("the graph", () => graph);
  expect(publishedTopics.length === viewer.channels.length, "the graph has every channel");
}

async function whoPublishesIsRefused(viewer) {
  const { client } = viewer;
  const id = client.advertise({ topic: "/cmd", encoding: "json", schemaName: "cmd" });
  client.sendMessage(id, Buffer.from('{"speed":99}'));
  await viewer.refusal(/read only.*clientPublish/);
  client.setParameters([{ name: "limit", value: 1 }], "x");
  await viewer.refusal(/no setParameters/);
  const data = new DataView(new ArrayBuffer(2));
  client.sendServiceCallRequest({ serviceId: 1, callId: 1, encoding: "json", data });
  await viewer.refusal(/no services/);
  client.subscribe(99_999);
  await viewer.refusal(/no channel 99999/);
  viewer.socket.send(Buffer.from([3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]));
  await viewer.refusal(/live car cannot be played back/);
}

/** Numbers that look random and are the same each time. */
function* numbers(seed) {
  for (let x = seed; ; yield x >>> 8) x = (Math.imul(x, 1_664_525) + 1_013_904_223) >>> 0;
}

async function nonsenseIsRefused(others) {
  const viewer = await Viewer.open(kProtocols[1]);
  const random = numbers(7);
  const next = (n) => random.next().value % n;
  for (let i = 0; i < 300; ++i) {
    const bytes = Buffer.from(Array.from({ length: next(60) }, () => next(256)));
    if (i % 3 === 0) viewer.socket.send(bytes);
    else if (i % 3 === 1) viewer.socket.send(bytes.toString("latin1"));
    else viewer.socket.send(`{"op":"subscribe","subscriptions":[${bytes.toString("hex")}]}`);
  }
  await until("every nonsense to be told", () => viewer.statuses.length >= 300);
  expect(viewer.closed === undefined, "who talks nonsense is told so, and stays");
  viewer.socket.send("x".repeat(64 * 1024 + 1));
  await until("the end of who says too much", () => viewer.closed === 1009);
  const before = others.times.length;
  await until("others not to notice", () => others.times.length > before + 2);
}

async function live() {
  for (const wrong of [["foxglove.websocket.v9"], []]) {
    const status = await wrongProtocol(wrong);
    expect(status === 400, `protocol [${wrong}] gets 400, not ${status}`);
  }
  const older = await Viewer.open(kProtocols[0]);
  const viewer = await Viewer.open(kProtocols[1]);
  const can = "time,parameters,parametersSubscribe,connectionGraph";
  expect(viewer.info.capabilities.join() === can, `capabilities ${viewer.info.capabilities}`);
  await whatTheCarSays(viewer);
  await thresholdsAreRead(viewer);
  await whoPublishesIsRefused(viewer);
  await nonsenseIsRefused(older);
  console.log(`${viewer.channels.length} channels, ${viewer.messages.size} with messages`);
}

function control(pause, speed, seek, request) {
  const bytes = Buffer.alloc(19 + request.length);
  bytes[0] = 3;
  bytes[1] = pause ? 1 : 0;
  bytes.writeFloatLE(speed, 2);
  bytes[6] = seek === undefined ? 0 : 1;
  bytes.writeBigUInt64LE(seek ?? 0n, 7);
  bytes.writeUInt32LE(request.length, 15);
  bytes.write(request, 19);
  return bytes;
}

async function replay() {
  const viewer = await Viewer.open(kProtocols[1]);
  const { capabilities, dataStartTime: start, dataEndTime: end } = viewer.info;
  expect(capabilities.includes("playbackControl"), `capabilities ${capabilities}`);
  const ns = ({ sec, nsec }) => BigInt(sec) * 1_000_000_000n + BigInt(nsec);
  expect(ns(end) > ns(start) + 2_000_000_000n, "the recording has a length");
  const ask = (pause, speed, seek, request) => {
    viewer.socket.send(control(pause, speed, seek, request));
    return until(request, () => viewer.states.find((state) => state.request === request));
  };
  expect((await ask(true, 1, undefined, "pause")).status === 1, "it pauses");
  const to = ns(start) + 1_000_000_000n;
  const jumped = await ask(true, 1, to, "jump");
  expect(jumped.didSeek && jumped.ns === to, `it jumps: ${jumped.ns} for ${to}`);
  viewer.subscribe((topic) => topic.startsWith("/car/"));
  const playing = await ask(false, 5, undefined, "play");
  expect(playing.status === 0 && playing.speed === 5, "it plays, at the speed that was asked for");
  const ego = await until("a state", () => viewer.messages.get("/car/ego"));
  expect(ego.timestamp >= to && ego.timestamp <= ns(end), "messages have the recording's time");
  expect(Math.abs(ego.value.vx - 50.5) < 0.1, "and its values");
  const seen = await until("an opponent", () => viewer.messages.get("/car/opponent_1"));
  expect(Math.abs(seen.value.station - 400) < 0.1, `it was at ${seen.value.station} m`);
  expect(Math.abs(seen.value.position_sigma - 0.5) < 0.03, "as surely as it was known");
  await until("the end", () => viewer.states.some(({ status }) => status === 3));
  viewer.client.advertise({ topic: "/cmd", encoding: "json", schemaName: "cmd" });
  await viewer.refusal(/read only/);
  console.log(`${viewer.states.length} states of the playback`);
}

async function ofOneCar() {
  const viewer = await Viewer.open(kProtocols[1]);
  const transforms = ["/tf", "/tf_static"]; // of all cars, as ROS has it
  for (const { topic } of viewer.channels) {
    expect(topic.startsWith(`${space}/`) || transforms.includes(topic), `${topic} is of ${space}`);
  }
  viewer.subscribe();
  const { value: ego } = await until("its state", () => viewer.messages.get(`${space}/car/ego`));
  expect(Math.abs(ego.vx - Number(speed)) < 0.1, `a speed of ${ego.vx}`);
  const link = await until("its link", () => viewer.messages.get(`${space}/base/values/link`));
  const frame = link.value.header.frame_id;
  expect(frame === `${space.slice(1)}/base_link`, `the frame ${frame}`);
}

async function ofTheBench() {
  const viewer = await Viewer.open(kProtocols[1]);
  viewer.subscribe();
  const { value: ego } = await until("its state", () => viewer.messages.get("/car/ego"));
  expect(Number.isFinite(ego.vx), `a speed of ${ego.vx}`);
  const { value: hello } = await until("the base", () => viewer.messages.get("/base/hello"));
  expect(hello.mode === "HIL", `it is told as a simulation, not ${hello.mode}`);
}

await { live, replay, space: ofOneCar, bench: ofTheBench }[mode]();
process.exit(0);
