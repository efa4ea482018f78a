/**
 * Which moment the screen shows: the newest, or one of the last ten minutes. Pausing and scrubbing
 * concern this console alone; alarms, flags in the alarm line and the stop buttons stay live.
 */
// SPDX-License-Identifier: Apache-2.0
import { computed, signal } from "@preact/signals";
import type { Reading } from "../store/reading";
import { kNothing } from "../store/reading";
import * as session from "../store/session";

/** Base time shown, null while live. */
export const heldMs = signal<number | null>(null);
/** Speed at which a held view plays; 0 is paused, negative backwards. */
export const speed = signal(0);
export const isLive = computed(() => heldMs.value === null);

export const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20] as const;

let row = -1;
let nowMs = NaN;
let silent = true;
let paused: number | null = null;

/** Once per drawn frame: moves a playing view on and fixes what this frame shows. */
export function beginFrame(localMs: number, elapsedMs: number): void {
  silent = session.clock.isSilent(localMs);
  nowMs = session.clock.nowMs(localMs);
  paused = session.clock.pauseMs(localMs);
  if (heldMs.value === null) return;
  if (speed.value !== 0) seek(heldMs.value + elapsedMs * speed.value);
  if (heldMs.value !== null) row = session.history.find(heldMs.value);
}

/** The base's time that is on the screen. */
export const shownMs = (): number => heldMs.value ?? nowMs;
export const liveMs = (): number => nowMs;
/** True where the base has fallen silent: nothing live may look alive. */
export const isSilent = (): boolean => silent;
/** For how long bench time stands; null where it goes on. */
export const pauseMs = (): number | null => paused;

export function seek(toMs: number): void {
  const { history } = session;
  if (history.size === 0) return;
  if (speed.value > 0 && toMs >= history.newestMs()) {
    backToLive();
    return;
  }
  heldMs.value = Math.min(Math.max(toMs, history.oldestMs()), history.newestMs());
  row = history.find(heldMs.value);
}

export function pause(): void {
  speed.value = 0;
  if (heldMs.value === null) seek(session.history.newestMs());
}

export function backToLive(): void {
  heldMs.value = null;
  speed.value = 0;
}

export function togglePlay(): void {
  if (heldMs.value === null) pause();
  else speed.value = speed.value === 0 ? 1 : 0;
}

/** One step up or down the ladder of speeds; starts playing where it stood. */
export function changeSpeed(up: boolean): void {
  if (heldMs.value === null) pause();
  const at = kSpeeds.indexOf(Math.abs(speed.value) as (typeof kSpeeds)[number]);
  const next = at < 0 ? kSpeeds.indexOf(1) : at + (up ? 1 : -1);
  speed.value = kSpeeds[Math.min(Math.max(next, 0), kSpeeds.length - 1)];
}

export function step(byMs: number): void {
  speed.value = 0;
  seek(shownMs() + byMs);
}

/** To the snapshot before or after the one shown. */
export function stepRow(by: number): void {
  const { history } = session;
  if (history.size === 0) return;
  speed.value = 0;
  const at = heldMs.value === null ? history.size - 1 : history.find(heldMs.value);
  const to = Math.min(Math.max(at + by, 0), history.size - 1);
  seek(history.timeMs[history.index(to)]);
}

const scratch: Reading = { ...kNothing };

/** What is to be shown of a slot in this frame. The object is used again by the next call. */
export function read(slot: number): Reading {
  if (heldMs.value !== null) return session.history.read(slot, row, scratch);
  return session.fields.value.read(slot, nowMs, silent, scratch);
}

/** The same by path, for what is drawn seldom. */
export const readPath = (path: string): Reading => read(session.fields.value.slot(path));

/** The newest value whatever the view shows: for the frame, whose flags are never of the past. */
export function readLive(slot: number): Reading {
  return session.fields.value.read(slot, nowMs, silent, scratch);
}
