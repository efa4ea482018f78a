/**
 * What time it is at the base, and how long the base has been silent. Between frames the base's
 * clock is carried on by the browser's, so that ages go on growing when nothing comes any more. It
 * stands while the base says that it does, and only as long as the base goes on saying so.
 */
// SPDX-License-Identifier: Apache-2.0

/** Silence of the base after which nothing on the screen may look alive. */
export const kSilenceMs = 500;
/** A frame and a text of one moment say it in different digits. */
const kSameMs = 1;

export class BaseClock {
  private lastBaseMs = NaN;
  private lastLocalMs = NaN;
  private utcOffsetMs = NaN;
  /** By the browser's clock; null: it goes on. */
  private standsSinceMs: number | null = null;

  received(baseMs: number, localMs: number): void {
    if (Math.abs(baseMs - this.lastBaseMs) > kSameMs) this.goesOn();
    this.lastBaseMs = baseMs;
    this.lastLocalMs = localMs;
  }

  /** The base answers, and for so long its time has stood. */
  stands(baseMs: number, stoodMs: number, localMs: number): void {
    this.received(baseMs, localMs);
    this.standsSinceMs = stoodMs > 0 ? localMs - stoodMs : null;
  }

  goesOn(): void {
    this.standsSinceMs = null;
  }

  /** For how long the base's time has stood; null where it goes on, or where nobody knows. */
  pauseMs(localMs: number): number | null {
    if (this.standsSinceMs === null || this.isSilent(localMs)) return null;
    return localMs - this.standsSinceMs;
  }

  tiesToUtc(baseMs: number, utcMs: number): void {
    this.utcOffsetMs = utcMs - baseMs;
  }

  nowMs(localMs: number): number {
    if (this.pauseMs(localMs) !== null) return this.lastBaseMs;
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
