/**
 * The recorder's controls, whatever they move: of a live car the view of this console alone, of a
 * replay the file that the base plays, for everyone who looks on.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../store/session";
import { send } from "../store/uplink";
import type { Playback } from "../wire/messages";
import * as timeline from "./timeline";

/** A snapshot's worth of a replay. */
const kRowMs = 40;

/** The playback of the base, null where the car is live. */
const file = (): Playback | null =>
  session.hello.value?.mode === "REPLAY" ? session.playback.value : null;

export function seekFile(toMs: number): void {
  const playback = file();
  if (!playback) return;
  const { begin_ms, end_ms } = playback;
  send({ type: "playback", to_ms: Math.min(Math.max(toMs, begin_ms), end_ms) });
}

export function togglePlay(): void {
  const playback = file();
  if (playback) send({ type: "playback", speed: playback.speed === 0 ? 1 : 0 });
  else timeline.togglePlay();
}

/** The next step of the ladder of speeds; from a pause it plays at 1. */
export function nextSpeed(speed: number, up: boolean): number {
  const { kSpeeds } = timeline;
  const at = kSpeeds.findIndex((s) => s === Math.abs(speed));
  if (at < 0) return 1;
  return kSpeeds[Math.min(Math.max(at + (up ? 1 : -1), 0), kSpeeds.length - 1)];
}

export function changeSpeed(up: boolean): void {
  const playback = file();
  if (playback) send({ type: "playback", speed: nextSpeed(playback.speed, up) });
  else timeline.changeSpeed(up);
}

export function step(byMs: number): void {
  const playback = file();
  if (playback) seekFile(playback.now_ms + byMs);
  else timeline.step(byMs);
}

export function stepRow(by: number): void {
  if (file()) step(by * kRowMs);
  else timeline.stepRow(by);
}

/** To the present of a live car; to the end of a file. */
export function toEnd(): void {
  const playback = file();
  if (playback) seekFile(playback.end_ms);
  else timeline.backToLive();
}
