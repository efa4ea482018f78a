/**
 * A tone for each alarm that comes, by its priority, and again while a high one is not seen, of
 * every car, whichever is shown. Off
 * until somebody switches it on, as browsers want it; silenced for a minute at most, and said so in
 * the recording.
 */
// SPDX-License-Identifier: Apache-2.0
import { effect, signal } from "@preact/signals";
import type { CarSession } from "../store/car_session";
import * as session from "../store/session";
import { send } from "../store/uplink";
import { kPriorities, needsEyes } from "../view/alarm_order";
import type { Priority } from "../view/alarm_order";
import type { Alarm } from "../wire/messages";

export const kMuteMs = 60_000;
const kAgainMs = 5000;
const kTones: Record<Priority, { hz: number; beeps: number }> = {
  high: { hz: 880, beeps: 3 },
  medium: { hz: 660, beeps: 2 },
  low: { hz: 440, beeps: 1 },
};
const kBeepS = 0.12;

export type Sound = "off" | "on" | "muted";
export const sound = signal<Sound>("off");
/** How many alarms were sounded: what a test can hear. */
export const sounded = { count: 0, last: "" as Priority | "" };

let context: AudioContext | null = null;
let unmute = 0;

function play(priority: Priority): void {
  ++sounded.count;
  sounded.last = priority;
  if (!context) return;
  const { hz, beeps } = kTones[priority];
  for (let i = 0; i < beeps; ++i) {
    const tone = new OscillatorNode(context, { frequency: hz });
    const at = context.currentTime + 2 * i * kBeepS;
    tone.connect(new GainNode(context, { gain: 0.3 })).connect(context.destination);
    tone.start(at);
    tone.stop(at + kBeepS);
  }
}

/** The loudest of those that are unseen now and were not before. */
export function newcomer(before: ReadonlySet<number>, active: readonly Alarm[]): Priority | null {
  const fresh = active.filter((alarm) => needsEyes(alarm) && !before.has(alarm.id));
  return kPriorities.find((p) => fresh.some((alarm) => alarm.priority === p)) ?? null;
}

export function pressSound(): void {
  clearTimeout(unmute);
  if (sound.value === "on") {
    sound.value = "muted";
    send({ type: "mark", text: `alarm sound muted for ${kMuteMs / 1000} s` });
    unmute = window.setTimeout(() => (sound.value = "on"), kMuteMs);
    return;
  }
  context ??= new AudioContext();
  void context.resume();
  sound.value = "on";
}

const activeOf = (car: CarSession): readonly Alarm[] => car.alarms.value?.active ?? [];

export function listenToAlarms(): void {
  const known = new Map<CarSession, ReadonlySet<number>>();
  effect(() => {
    const fresh = session.cars.value.map((car) => {
      const priority = newcomer(known.get(car) ?? new Set(), activeOf(car));
      known.set(car, new Set(activeOf(car).map((alarm) => alarm.id)));
      return priority;
    });
    const loudest = kPriorities.find((priority) => fresh.includes(priority));
    if (loudest && sound.value === "on") play(loudest);
  });
  setInterval(() => {
    const waits = session.cars.value
      .flatMap(activeOf)
      .some((alarm) => alarm.priority === "high" && alarm.state === "unack");
    if (waits && sound.value === "on") play("high");
  }, kAgainMs);
}
