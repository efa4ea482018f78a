/**
 * Whether the base is there: heard, silent, or gone. A console that does not hear its base knows
 * nothing of the car; one whose base is gone cannot stop it either. While the base is silent but
 * connected a stop still goes out: it may only be late.
 */
// SPDX-License-Identifier: Apache-2.0
import type { Signal } from "@preact/signals";

export type Presence = "here" | "silent" | "gone";

/** A busy machine is silent for a moment; a page does not move for that. */
export const kSilentMs = 1000;
/** As long as the authority lasts. Nothing that is sent now is known to arrive. */
export const kGoneMs = 3000;
/** How long a page that has just been opened waits for the first word. */
export const kOpeningMs = 1500;
const kLookEveryMs = 100;

export function presenceOf(connected: boolean, silenceMs: number, openMs: number): Presence {
  if (openMs < kOpeningMs && !Number.isFinite(silenceMs)) return "here";
  if (!connected || silenceMs > kGoneMs) return "gone";
  return silenceMs > kSilentMs ? "silent" : "here";
}

/** What is looked at of a car, and where the result is kept. */
interface Watched {
  connected: Signal<boolean>;
  clock: { silenceMs(local: number): number };
  presence: Signal<Presence>;
}

function look(cars: readonly Watched[]): void {
  const local = performance.now();
  for (const car of cars) {
    car.presence.value = presenceOf(car.connected.value, car.clock.silenceMs(local), local);
  }
}

export function watchPresence(cars: () => readonly Watched[]): void {
  setInterval(() => look(cars()), kLookEveryMs);
}
