/**
 * What time it is at the base, and how long the base has been silent. Between frames the base's
 * clock is carried on by the browser's, so that ages go on growing when nothing comes any more.
 */
// SPDX-License-Identifier: Apache-2.0

/** Silence of the base after which nothing on the screen may look alive. */
export const kSilenceMs = 500;

export class BaseClock {
  private lastBaseMs = NaN;
  private lastLocalMs = NaN;
  private utcOffsetMs = NaN;

  heard(baseMs: number, localMs: number): void {
    this.lastBaseMs = baseMs;
    this.lastLocalMs = localMs;
  }

  tiesToUtc(baseMs: number, utcMs: number): void {
    this.utcOffsetMs = utcMs - baseMs;
  }

  nowMs(localMs: number): number {
    return this.lastBaseMs + (localMs - this.lastLocalMs);
  }

  silenceMs(localMs: number): number {
    return Number.isNaN(this.lastLocalMs) ? Infinity : localMs - this.lastLocalMs;
  }

  isSilent(localMs: number): boolean {
    return this.silenceMs(localMs) > kSilenceMs;
  }

  utcMs(baseMs: number): number {
    return baseMs + this.utcOffsetMs;
  }
}
