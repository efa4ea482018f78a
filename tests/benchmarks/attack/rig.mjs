/**
 * The attacked pair, its quiet twin and the attacker; attacks begin and end here.
 */
// SPDX-License-Identifier: Apache-2.0
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { kBase } from "../../system/console/programs.mjs";
import { eventually, now, pause } from "../console/rig.mjs";
import { kLimits } from "./limits.mjs";
import { Pair, Tool, freePort, kCarFile, startVehicle } from "./pair.mjs";
import { kAlarms } from "./phases.mjs";

const kNsPerMs = 1e6;
const kStarts = 1000;
const kPatienceMs = 10_000;
const kRogueDelayMs = 1;

export class Rig {
  attacked = new Pair("attacked");
  twin = new Pair("twin");
  /** Lines of the attacker: newest of each word, and how many. */
  heard = {};

  get pairs() {
    return [this.attacked, this.twin];
  }

  async start() {
    const ports = [await freePort(), await freePort()];
    const hear = ([word, ...numbers]) => (this.heard[word] = numbers.map(Number));
    this.attacker = await new Tool("attacker", [ports[0]], hear).ready();
    for (const pair of this.pairs) pair.receivers = `${await freePort()},${await freePort()}`;
    await this.attacked.prepare(ports[0], this.attacker.port);
    await this.twin.prepare(ports[1]);
    await this.#recordStarts();
    await Promise.all(this.pairs.map((pair) => pair.startBase()));
    for (const pair of this.pairs) pair.startCar();
    await eventually("both links", () => this.linked, kPatienceMs);
    await this.#prepareRogues(ports[0]);
  }

  get linked() {
    return this.pairs.every((pair) => pair.linked);
  }

  /** True when both cars have let go of the stop. */
  async release(limitMs) {
    const released = await Promise.all(this.pairs.map((pair) => pair.release(limitMs)));
    return released.every(Boolean);
  }

  /** The attacker was there before: a season of starts of this car, while no base heard them. */
  async #recordStarts() {
    const words = [this.attacked.keys, `127.0.0.1:${this.attacked.radio.port}`, kStarts];
    const starts = new Tool("car_starts", words);
    const [code] = await new Promise((done) => starts.process.once("exit", (...how) => done(how)));
    if (code !== 0) throw new Error(`car_starts ended with ${code}`);
    await pause(100);
    const [openings] = await this.#ask("known");
    if (openings < kStarts) throw new Error(`${openings} openings recorded, expected ${kStarts}`);
  }

  async #ask(word) {
    delete this.heard[word];
    this.attacker.say(word);
    return eventually(`the attacker's "${word}"`, () => this.heard[word]);
  }

  /** Another car beside ours: a bus, other keys, a car file that wants signed packets. */
  async #prepareRogues(basePort) {
    const folder = join(this.attacked.programs.folder, "rogue");
    mkdirSync(folder);
    execFileSync(kBase, ["keygen", "--out", join(folder, "keys")]);
    this.otherKeys = join(folder, "keys/car.keys");
    const text = readFileSync(kCarFile, "utf8");
    const signed = text.replace(/signed_only: false/, "signed_only: true");
    if (signed === text) throw new Error(`${kCarFile}: no signed_only: false`);
    // Its own includes are relative to its folder.
    this.signedCarFile = join(folder, "av21.yaml");
    writeFileSync(this.signedCarFile, signed);
    this.rogueBus = `unix:${join(folder, "bus")}`;
    this.rogueStand = await new Tool("standing_car", [this.rogueBus]).ready();
    this.rogueReceivers = `${await freePort()},${await freePort()}`;
    const hear = ([word, , ns]) => word === "car" && (this.knocked ??= Number(ns) / kNsPerMs);
    this.rogueRadio = await new Tool("attack_radio", [basePort, kRogueDelayMs], hear).ready();
  }

  /** Begins the attack of a phase; resolves with when its first datagram left. */
  async begin(phase) {
    if (phase.crowd) return this.#gather(phase);
    if (phase.attack) {
      delete this.heard.begun;
      delete this.heard.ended;
      this.attacker.say(phase.attack);
      const [ns] = await eventually(`a datagram of "${phase.attack}"`, () => this.heard.begun);
      return ns / kNsPerMs;
    }
    if (!phase.rogue) return now();
    this.knocked = undefined;
    this.rogue = startVehicle({
      bus: this.rogueBus,
      reports: this.rogueStand.port,
      radio: this.rogueRadio.port,
      keys: phase.rogue.keys === "own" ? this.attacked.keys : this.otherKeys,
      receivers: this.rogueReceivers,
      ...(phase.rogue.signed ? { carFile: this.signedCarFile } : {}),
    });
    return eventually("the other car's first datagram", () => this.knocked, kPatienceMs);
  }

  /** First the limit, then who comes. */
  async #gather({ limit, crowd }) {
    const { programs, recording } = this.attacked;
    this.giveBack = limit && (await kLimits[limit](programs.base, recording));
    const begun = now();
    await this.attacked.crowd(crowd);
    return begun;
  }

  /** The same attack once more; what it sent so far is forgotten. */
  again(phase) {
    this.attacker.say(phase.attack);
  }

  /** Ends it; resolves with what the attacker sent and was answered: datagrams and bytes. */
  async end(phase) {
    this.rogue?.kill("SIGKILL");
    this.rogue = undefined;
    this.attacked.visitors?.close();
    this.attacked.visitors = undefined;
    this.giveBack?.();
    this.giveBack = undefined;
    if (!phase.attack) return undefined;
    this.attacker.say("stop");
    const counts = await eventually("the attacker's end", () => this.heard.ended);
    const [sent, bytes, answers, answerBytes] = counts;
    return { sent, bytes, answers, answerBytes };
  }

  /** Restarts in both pairs at once; resolves with how long each then took to its link. */
  async restart(what, limitMs) {
    this.attacker.say("mark");
    const parts = what === "both" ? ["car", "base"] : [what];
    return Promise.all(
      this.pairs.map(async (pair) => {
        let since;
        for (const part of parts) since = await pair.restart(part);
        return { pair, linked: pair.linkedAfter(since, limitMs) };
      }),
    );
  }

  /** Alarms of attacks that stand in a pair now. */
  standing(pair) {
    const keys = Object.values(kAlarms);
    const active = pair.console.newest.alarms?.active ?? [];
    return active.filter(({ key }) => keys.includes(key)).map(({ key }) => key);
  }

  /** Everything seen and reset, as an operator does after an attack. */
  acknowledge() {
    for (const { console } of this.pairs) {
      const active = console.newest.alarms?.active ?? [];
      if (active.length > 0) console.say({ type: "ack", all: active.map(({ id }) => id) });
      for (const { id, state } of active) {
        if (state === "latched") console.say({ type: "reset", alarm: id });
      }
    }
  }

  /** Base and car of a pair anew, where nothing else gives them a link again. */
  async heal(pair) {
    await pair.restart("base");
    await pair.restart("car");
    await eventually("a link after both were started anew", () => pair.linked, kPatienceMs);
  }

  async close() {
    this.rogue?.kill("SIGKILL");
    this.attacker?.close();
    this.rogueRadio?.close();
    this.rogueStand?.close();
    await Promise.all(this.pairs.map((pair) => pair.close()));
  }
}
