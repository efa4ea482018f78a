/**
 * A piece of a replay that is played again and again: set from its begin A to its end B while the
 * file plays, turned back by the console that set it, for everyone who looks on.
 */
// SPDX-License-Identifier: Apache-2.0
import { effect, signal } from "@preact/signals";
import * as session from "../store/session";
import type { Playback } from "../wire/messages";
import { seekFile } from "./transport";

export interface Loop {
  fromMs: number;
  /** null: B is not set yet. */
  toMs: number | null;
}

/** The end of a file is where its playing stops: a loop turns back before that. */
const kBeforeEndMs = 200;
const kShortestMs = 500;

export const loop = signal<Loop | null>(null);

/** What setting the next mark makes of a loop: A, then B, then no loop. */
export function marked(now: Loop | null, playback: Playback): Loop | null {
  if (!now) return { fromMs: playback.now_ms, toMs: null };
  if (now.toMs !== null) return null;
  const [fromMs, toMs] = [now.fromMs, playback.now_ms].sort((a, b) => a - b) as [number, number];
  const last = playback.end_ms - kBeforeEndMs;
  const end = Math.min(Math.max(toMs, fromMs + kShortestMs), last);
  return end > fromMs ? { fromMs, toMs: end } : null;
}

/** Where the file has to go on, null while it plays within the loop or stands. */
export function turn(now: Loop | null, playback: Playback | null): number | null {
  if (!playback || !now || now.toMs === null) return null;
  if (playback.speed > 0 && playback.now_ms >= now.toMs) return now.fromMs;
  if (playback.speed < 0 && playback.now_ms <= now.fromMs) return now.toMs;
  return null;
}

export function setMark(): void {
  const playback = session.playback.value;
  if (playback) loop.value = marked(loop.value, playback);
}

/** Turns the file back from now on, once for each of its jumps; returns what ends that. */
export function follow(): () => void {
  let turnedAt = -1;
  return effect(() => {
    const playback = session.playback.value;
    const to = turn(loop.value, playback);
    if (to === null || !playback || playback.jumps === turnedAt) return;
    turnedAt = playback.jumps;
    seekFile(to);
  });
}
