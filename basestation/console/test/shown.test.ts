/**
 * What the screen says of a value that is late, stale or was never heard: its age, and no claim
 * that nobody can make any more.
 */
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, test } from "vitest";
import type { Reading } from "../src/store/reading";
import { ageText } from "../src/view/format";
import {
  flagColour,
  flagWord,
  isKnown,
  kOutcomeMs,
  shownAge,
  stateWord,
  stopOutcome,
} from "../src/view/shown";
import { Judgement, Quality } from "../src/wire/status";

const kAll = [Quality.fresh, Quality.late, Quality.stale, Quality.never];

const reading = (quality: Quality, value = 1, judgement = Judgement.none): Reading => ({
  value,
  quality,
  judgement,
  unknown: false,
  ageMs: quality === Quality.never ? Infinity : 2500,
});

describe("the age", () => {
  test("stands beside what is late or stale, and beside nothing else", () => {
    expect(kAll.map((quality) => shownAge(reading(quality)))).toEqual(["", "2.5 s", "2.5 s", ""]);
  });

  test("has three digits, in steps that a reader can follow", () => {
    for (const [ms, text] of [
      [0, "0 ms"],
      [344, "340 ms"],
      [999, "1000 ms"],
      [1000, "1.0 s"],
      [9999, "10.0 s"],
      [10_000, "10 s"],
      [99_499, "99 s"],
      [100_000, "2 min"],
      [600_000, "10 min"],
      [Infinity, "never"],
      [NaN, "never"],
    ] as const)
      expect(ageText(ms)).toBe(text);
  });
});

test("known is what is fresh or late", () => {
  expect(kAll.map((quality) => isKnown(reading(quality)))).toEqual([true, true, false, false]);
});

test("a screen reader hears the judgement of what is known, else why there is none", () => {
  const judged = [Judgement.none, Judgement.good, Judgement.warning, Judgement.bad];
  for (const quality of [Quality.fresh, Quality.late]) {
    const words = judged.map((judgement) => stateWord(reading(quality, 1, judgement)));
    expect(words).toEqual(["", "good", "warning", "bad"]);
  }
  for (const judgement of judged) {
    expect(stateWord(reading(Quality.stale, 1, judgement))).toBe("stale");
    expect(stateWord(reading(Quality.never, 1, judgement))).toBe("not received yet");
  }
});

describe("a flag", () => {
  test.each([
    ["PURPLE EMERGENCY", "purple"],
    ["RED", "red"],
    ["STOP", "red"],
    ["ENGINE KILL", "red"],
    ["ORANGE START ENGINE", "orange"],
    ["YELLOW", "yellow"],
    ["WAVING GREEN", "green"],
    ["CHEQUERED", "chequered"],
    ["BLUE", "blue"],
    ["BLACK PIT IN", "black"],
    ["DEFENDER", "none"],
  ])("%s has its colour while it is known", (label, colour) => {
    const colours = kAll.map((quality) => flagColour(reading(quality), label));
    expect(colours).toEqual([colour, colour, "none", "none"]);
  });

  test("keeps its word while it is old, and has a dash where nothing was said", () => {
    const words = kAll.map((quality) => flagWord(reading(quality), "RED"));
    expect(words).toEqual(["RED", "RED", "RED", "\u2013"]);
    expect(flagWord(reading(Quality.fresh), undefined)).toBe("\u2013");
    expect(flagColour(reading(Quality.fresh), undefined)).toBe("none");
  });
});

describe("the outcome of a stop", () => {
  const nothing = { text: "", failed: false };
  const pressed = (sent: boolean, at = 1000) => ({ kind: "controlled" as const, sent, at });

  test("a latch is shown while the car's word of it is known", () => {
    const shown = (quality: Quality, value: number) =>
      stopOutcome(reading(quality, value), "controlled stop", null, 0);
    const latched = { text: "car: controlled stop", failed: false };
    expect(kAll.map((q) => shown(q, 1))).toEqual([latched, latched, nothing, nothing]);
    expect(kAll.map((q) => shown(q, 0))).toEqual([nothing, nothing, nothing, nothing]);
    expect(stopOutcome(reading(Quality.fresh), undefined, null, 0).text).toBe("car: stops");
  });

  test("a press that was not sent says so first, for as long as it is recent", () => {
    for (const value of [0, 1]) {
      const at = (nowMs: number) =>
        stopOutcome(reading(Quality.fresh, value), "latched", pressed(false), nowMs);
      expect(at(1000 + kOutcomeMs - 1)).toEqual({ text: "NOT SENT: no base", failed: true });
      expect(at(1000 + kOutcomeMs)).toEqual(
        value ? { text: "car: latched", failed: false } : nothing,
      );
    }
    expect(kOutcomeMs).toBe(4000);
  });

  test("a press that was sent waits for the car's word", () => {
    const at = (nowMs: number, quality = Quality.fresh, value = 0) =>
      stopOutcome(reading(quality, value), "latched", pressed(true), nowMs).text;
    expect(at(4999)).toBe("sent to the base");
    expect(at(5000)).toBe("");
    expect(at(4999, Quality.late, 1)).toBe("car: latched");
    expect(at(4999, Quality.stale, 1)).toBe("sent to the base");
  });
});
