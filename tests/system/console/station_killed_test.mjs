/**
 * The real base is killed while it records a car that drives: the unmodified car program on a bus
 * over a Unix socket, with its black box. By its own recording the car goes down the ladder of its
 * radio and stops; the base has lost less than a second, and started again it shows the same race
 * with its history. All by one bench time, where the test is given one.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, test } from "node:test";
import { nowMs, pass } from "../../support/test_clock.mjs";
import { attachCar, saidBy } from "./attached_car.mjs";
import { Client, eventually } from "./client.mjs";
import { events, samples } from "./lcm_log.mjs";
import { Programs } from "./programs.mjs";

const kFastMps = 15;
const kDeadMs = 6000;
const kWhyItStands = /^(mode|radio|ego|control)\./;
/** What a kill may take from the recording. */
const kMayBeLostMs = 1000;
/** Of radio.rung: ages of the link, as vehicle/config/cars/av21.yaml has them; and slack. */
const kRungsMs = [0, 200, 500, 1000, 3000];
const kSlackMs = 250;
const kDriving = 2;
const kControlledStop = 3;
const kEmergencyStop = 4;
const kHalted = 5;

const programs = new Programs();
after(() => programs.close());

const ended = (process) => new Promise((done) => process.once("exit", done));
const screen = () => saidBy(programs);

/** What the car made of itself, from its own recording: a line for each change of its mode. */
function storyOf(own, paths, zeroMs) {
  const story = [];
  const fields = paths.filter((path) => path.startsWith("mode.") || path.startsWith("uplink."));
  const columns = fields.map((path) => samples(own, paths, path));
  let before = NaN;
  samples(own, paths, "mode.mode").forEach(({ ms, value }) => {
    if (value === before) return;
    before = value;
    const then = columns.map((column) => column.findLast((sample) => sample.ms <= ms)?.value);
    const values = fields.map((path, n) => `${path} ${then[n]}`).join(", ");
    story.push(`${((ms - zeroMs) / 1000).toFixed(2)} s after the last datagram: ${values}`);
  });
  return story.join("\n");
}

/** Values of one field that the base has, oldest first: [{s, value}] before now. */
async function history(client, path) {
  const { id } = client.newest.catalogue.fields.find((field) => field.path === path);
  const told = new Promise((done) => {
    const hear = (data, isBinary) => {
      if (!isBinary || data[0] !== 2 || data.readUInt16LE(24) !== id) return;
      client.socket.off("message", hear);
      done(data);
    };
    client.socket.on("message", hear);
  });
  client.say({ type: "history", field: id, from_s: 60, to_s: 0, points: 20_000 });
  const data = await told;
  const now = Number(data.readBigUInt64LE(16)) / 1e9;
  const points = [];
  for (let at = 32; at < data.length; at += 16) {
    points.push({ s: now - data.readDoubleLE(at), value: data.readFloatLE(at + 8) });
  }
  return points;
}

test("a base that is killed: the car's ladder, the recording, the race again", async () => {
  const recording = join(programs.folder, "recording");
  const first = await Client.open(await programs.startBase("--record", recording));
  const paths = (await first.until("a catalogue", () => first.newest.catalogue)).fields
    .filter(({ path }) => !/^(link|derived|base)\./.test(path))
    .map(({ path }) => path);
  const car = await attachCar(programs, "hil/scenarios/launch.yaml", 120);
  let speed = NaN;
  try {
    await eventually("a car that drives", async () => {
      speed = (await history(first, "ego.vx")).at(-1)?.value;
      const mode = (await history(first, "mode.mode")).at(-1)?.value;
      if (mode === kHalted) throw new Error("the car will not drive any more");
      return speed > kFastMps;
    });
  } catch (error) {
    error.message += `\n${screen()}`;
    for (const path of paths.filter((name) => kWhyItStands.test(name))) {
      error.message += `\n${path}: ${(await history(first, path)).at(-1)?.value}`;
    }
    throw error;
  }
  await pass(kMayBeLostMs);
  first.close();
  const killedMs = nowMs();
  await programs.kill("base");

  const newest = Math.max(...events(recording).map(({ ms }) => ms));
  assert.ok(killedMs - newest < kMayBeLostMs, `${killedMs - newest} ms of the recording are lost`);

  await pass(kDeadMs);
  const again = await Client.open(await programs.startBase("--record", recording));
  await eventually("the same car", () => again.newest.hello.mode === "HIL");
  await pass(2000);
  const points = await history(again, "ego.vx");
  again.close();
  const deadS = (nowMs() - killedMs) / 1000;
  const before = points.filter(({ s }) => s > deadS);
  const after = points.filter(({ s }) => s < deadS - kDeadMs / 1000);
  assert.ok(
    before.some(({ value }) => value > kFastMps - 1),
    "how fast it was before the kill",
  );
  assert.ok(before.length > 200 && after.length > 20, `${before.length}, ${after.length} points`);
  assert.ok(after.at(-1).value < speed, "it brakes");
  assert.match(programs.baseSaid, /restored: \d+ messages/);

  car.kill("SIGTERM");
  await ended(car);
  const own = events(join(programs.folder, "box"));
  const heard = own.filter(({ channel, ms }) => channel === "/radio/up" && ms < killedMs + 500);
  const last = heard.at(-1).ms;
  const story = storyOf(own, paths, last);
  const rungs = samples(own, paths, "radio.rung").filter(({ ms }) => ms > last);
  kRungsMs.forEach((limit, rung) => {
    const reached = rungs.find(({ value }) => value >= rung)?.ms - last;
    assert.ok(
      reached >= limit - kSlackMs / 5 && reached <= limit + kSlackMs,
      `rung ${rung} was reached ${reached} ms after the last datagram, not ${limit}\n${story}`,
    );
  });
  const modes = samples(own, paths, "mode.mode");
  const at = (ms) => modes.findLast((sample) => sample.ms <= ms).value;
  assert.equal(at(last), kDriving, story);
  assert.equal(at(last + kRungsMs[3]), kDriving, `a fade is driven through\n${story}`);
  assert.equal(at(last + kRungsMs[4] + kSlackMs), kControlledStop, story);
  assert.ok(!modes.some(({ value }) => value === kEmergencyStop), story);
  const stopped = modes.filter(({ ms }) => ms > last + kRungsMs[4] + kSlackMs);
  assert.ok(!stopped.some(({ value }) => value === kDriving), "back, a base moves nobody");
});
