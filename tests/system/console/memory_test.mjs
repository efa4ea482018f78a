/**
 * What the real base keeps of what people gave it: a file of settings that cannot be read is told
 * and kept, and a base that is killed knows again what operators had entered.
 */
// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import { Client } from "./client.mjs";
import { kBase, Programs } from "./programs.mjs";

const kBroken = "version: 1\nalarms:\n  - {alarm: wheel_slip, limit: far, author: Ada}\n";
/** A chunk of the recording is on its way to the disk by then. */
const kChunkMs = 1200;

let programs;
beforeEach(() => (programs = new Programs()));
afterEach(() => programs.close());

async function holder(address) {
  const client = await Client.open(address);
  client.say({ type: "authority", do: "take" });
  const own = () => client.newest.authority?.holder === client.newest.hello.client;
  await client.until("authority", own);
  return client;
}

const isActive = (client) =>
  client.newest.alarms?.active.some(
    ({ key, state }) => key === "settings_unreadable" && state !== "rtn_unack",
  );

test("a settings file that cannot be read is told, and kept when it is replaced", async () => {
  const file = join(programs.folder, "wall.yaml");
  writeFileSync(file, kBroken);
  const address = await programs.startBase("--judgement", file);
  assert.match(
    programs.baseSaid,
    /settings file unreadable: \S+wall\.yaml:3:\d+: .+; built-in limits in force/,
  );
  const client = await holder(address);
  await client.until("an alarm", () => isActive(client));
  await client.until("its place", () => /wall\.yaml:3:/.test(client.newest.settings?.problem));
  const isSaid = ({ type, what }) => type === "audit" && /wall\.yaml:3:/.test(what);
  assert.ok(client.texts.some(isSaid), "a line of the audit log");
  const slip = () => client.newest.settings.alarms.find(({ key }) => key === "wheel_slip");
  assert.equal(slip().limit, 0.08, "as it came");
  assert.equal(readFileSync(file, "utf8"), kBroken, "nobody has touched the file");

  const { priority, deadband, on_s, off_s } = slip();
  const key = "wheel_slip";
  const edit = { type: "edit_alarm", key, priority, limit: 0.11, deadband, on_s, off_s };
  client.say({ ...edit, reason: "new tyres" });
  await client.until("revision 1", () => client.newest.settings.revision === 1);
  assert.equal(client.newest.settings.problem, "");
  await client.until("no alarm", () => !isActive(client));
  assert.equal(readFileSync(`${file}.broken`, "utf8"), kBroken);
  assert.match(readFileSync(file, "utf8"), /limit: 0\.11/);
  client.close();
});

test("a base that is killed knows again what operators had entered", async () => {
  const recording = join(programs.folder, "recording");
  const first = await programs.startBase("--record", recording);
  programs.startCar();
  const client = await holder(first);
  client.say({ type: "expect", round_speed: 51.4 });
  client.say({ type: "fuel_loaded", litres: 40 });
  await client.until("both", () => client.newest.expected?.fuel_loaded_l === 40);
  const before = client.newest.expected;
  const { name } = client.newest.hello;
  await sleep(kChunkMs);
  await programs.kill("base");

  const again = await Client.open(await programs.startBase("--record", recording));
  await again.until("known again", () => again.newest.expected?.fuel_loaded_l === 40);
  const after = again.newest.expected;
  assert.equal(after.round_speed_mps, 51.4);
  for (const member of ["round_speed_by", "fuel_by"]) assert.equal(after[member], before[member]);
  assert.ok(Math.abs(after.fuel_ms - before.fuel_ms) < 1, "entered when it was entered");
  assert.equal(after.fuel_left_l, 40, "the car told of no engine");
  const lines = again.texts.filter(({ type, what }) => type === "audit" && /fuel in/.test(what));
  assert.equal(lines.length, 1, `${name}'s line`);
  await again.until("the car", () => again.newest.hello.mode !== "NONE");
  await sleep(kChunkMs);
  again.close();
  await programs.kill("base");
  const judged = execFileSync(kBase, ["judge", recording], { encoding: "utf8" });
  assert.match(judged, / 0 differ/, "and a replay judges by it");
});
