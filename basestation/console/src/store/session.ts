/**
 * The cars of the base, and what is known of the one that is shown: each name here means that car,
 * from the moment it is shown. What concerns all of them goes through `cars`.
 */
// SPDX-License-Identifier: Apache-2.0
import { computed, effect, signal } from "@preact/signals";
import type { Signal } from "@preact/signals";
import type { History as HistoryAnswer } from "../wire/frame";
import { CarSession, kKeptLines } from "./car_session";

export { kKeptLines };

/** In the order of the base. Never empty: before it has answered there is one of no number. */
export const cars = signal<readonly CarSession[]>([new CarSession()]);
const chosen = signal<CarSession>(cars.value[0]);
export const shownCar = computed(() =>
  cars.value.includes(chosen.value) ? chosen.value : cars.value[0],
);
/** Several cars: then each page says whose it is. */
export const hasSeveral = computed(() => cars.value.length > 1);

export function showCar(car: CarSession): void {
  chosen.value = car;
}

/** A signal of the car that is shown. */
class OfShown<T> {
  constructor(private readonly of: (car: CarSession) => Signal<T>) {}
  get value(): T {
    return this.of(shownCar.value).value;
  }
  set value(to: T) {
    this.of(shownCar.peek()).value = to;
  }
}

export const connected = new OfShown((car) => car.connected);
export const presence = new OfShown((car) => car.presence);
export const hello = new OfShown((car) => car.hello);
export const fields = new OfShown((car) => car.fields);
export const commands = new OfShown((car) => car.commands);
export const alarms = new OfShown((car) => car.alarms);
export const alarmEvents = new OfShown((car) => car.alarmEvents);
export const authority = new OfShown((car) => car.authority);
export const ladder = new OfShown((car) => car.ladder);
export const audit = new OfShown((car) => car.audit);
export const carEvents = new OfShown((car) => car.carEvents);
export const marks = new OfShown((car) => car.marks);
export const link = new OfShown((car) => car.link);
export const notices = new OfShown((car) => car.notices);
export const stopState = new OfShown((car) => car.stopState);
export const race = new OfShown((car) => car.race);
export const fuel = new OfShown((car) => car.fuel);
export const expected = new OfShown((car) => car.expected);
export const settings = new OfShown((car) => car.settings);
export const checklist = new OfShown((car) => car.checklist);
export const playback = new OfShown((car) => car.playback);
export const benchTime = new OfShown((car) => car.benchTime);
export const track = new OfShown((car) => car.track);
export const lastError = new OfShown((car) => car.lastError);

/** Read at each frame, so plain values of the car that is shown. */
export let { clock, counters } = shownCar.value;
export let history = shownCar.value.history.value;
effect(() => {
  ({ clock, counters } = shownCar.value);
  history = shownCar.value.history.value;
});

export const awaitHistory = (field: number, waiter: (answer: HistoryAnswer) => void): void =>
  shownCar.value.awaitHistory(field, waiter);
