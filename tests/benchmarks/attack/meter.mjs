/**
 * What one pair of base and car did in one phase: packets, gaps, processor, memory, and what its
 * operator was told. Times are ms of the monotonic clock.
 */
// SPDX-License-Identifier: Apache-2.0
import { now, quantile } from "../console/rig.mjs";

const kPollMs = 500;
/** The presses of the measurement raise it themselves. */
const kOwnAlarm = "emergency_stop";
/** `uplink.link_age` says no more than this: see the registry. */
const kOldestMs = 5000;

/** Adds up a count that begins anew when its process does. */
class Sum {
  total = 0;

  begin(value) {
    this.last = value;
    return this;
  }

  add(value) {
    if (value === undefined) return;
    this.total += value >= this.last ? value - this.last : value;
    this.last = value;
  }
}

/** The longest time between two of these moments; those from before `from` begin it. */
function worstGap(moments, from) {
  let before = from;
  let worst = 0;
  for (const moment of moments) {
    worst = Math.max(worst, moment - before);
    before = Math.max(before, moment);
  }
  return worst;
}

export class Meter {
  stops = [];

  static async on(pair) {
    const meter = new Meter();
    meter.pair = pair;
    meter.from = now();
    const { packets, refused } = await pair.counts();
    const { base, car } = pair.usage();
    const sum = (value) => new Sum().begin(value);
    meter.sums = {
      packets: sum(packets),
      refused: sum(refused),
      accepted: sum(pair.newest.accepted),
      refusedByCar: sum(pair.newest.refused),
      base: sum(base.busy),
      car: sum(car.busy),
    };
    meter.polling = setInterval(() => meter.#poll(), kPollMs);
    return meter;
  }

  async #poll() {
    const { base, car } = this.pair.usage();
    this.resident = { base: base.resident, car: car.resident };
    if (base.busy > 0) this.sums.base.add(base.busy);
    if (car.busy > 0) this.sums.car.add(car.busy);
    this.sums.accepted.add(this.pair.newest.accepted);
    this.sums.refusedByCar.add(this.pair.newest.refused);
    const counts = await this.pair.counts().catch(() => undefined); // a base that restarts
    this.sums.packets.add(counts?.packets);
    this.sums.refused.add(counts?.refused);
  }

  async end() {
    clearInterval(this.polling);
    await this.#poll();
    this.to = now();
  }

  #rate(name) {
    return (this.sums[name].total / (this.to - this.from)) * 1000;
  }

  figures() {
    const { reports, consoles } = this.pair;
    const heardUp = reports
      .filter(({ at, age }) => at >= this.from && age >= 0 && age < kOldestMs)
      .map(({ at, age }) => at - age);
    const heardDown = consoles
      .flatMap(({ silences }) => silences)
      .filter(({ at }) => at >= this.from)
      .map(({ at, value }) => at - value);
    return {
      down_per_s: this.#rate("packets"),
      down_gap_ms: worstGap([...heardDown, this.to], this.from),
      up_per_s: this.#rate("accepted"),
      up_gap_ms: worstGap([...heardUp, this.to], this.from),
      stops: this.stops.length,
      stop_p50_ms: quantile(this.stops, 0.5) ?? 0,
      stop_p99_ms: quantile(this.stops, 0.99) ?? 0,
      base_percent: this.#rate("base") / 10,
      car_percent: this.#rate("car") / 10,
      base_mb: this.resident.base,
      car_mb: this.resident.car,
      refused_by_base_per_s: this.#rate("refused"),
      refused_by_car_per_s: this.#rate("refusedByCar"),
    };
  }

  /** Alarms that were announced in this phase: how long after `begun`, by key. */
  alarms(begun) {
    const told = new Map();
    const events = this.pair.consoles.flatMap(({ texts }) => texts);
    for (const { type, key, to, time_ms: at } of events) {
      if (type !== "alarm_event" || to !== "unack" || key === kOwnAlarm || at < this.from) continue;
      if (!told.has(key)) told.set(key, at - begun);
    }
    return told;
  }

  /** Events of car and base that came in this phase. */
  events() {
    return this.pair.consoles
      .flatMap(({ texts }) => texts)
      .filter(({ type, time_ms: at }) => type === "event" && at >= this.from)
      .map(({ text }) => text);
  }
}
