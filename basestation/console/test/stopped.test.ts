/**
 * What is said of a stopped car, of a staged command and of a base that does not answer.
 */
// SPDX-License-Identifier: Apache-2.0
import { afterEach, describe, expect, test } from "vitest";
import { choicesOf } from "../src/pages/commands/argument";
import { gateValueText, overrideWants } from "../src/pages/commands/stage";
import { kGoneMs, kOpeningMs, kSilentMs, presenceOf } from "../src/store/presence";
import { colourOfFlag } from "../src/view/shown";
import { kSpeedUnits, speedUnit } from "../src/view/speed_unit";
import { quantityText, inDisplayUnits } from "../src/view/display_units";
import type { CommandInfo, Gate } from "../src/wire/messages";

const inUnit = (name: string) => (speedUnit.value = kSpeedUnits.find((u) => u.name === name)!);
afterEach(() => inUnit("mph"));

describe("sentences of the base", () => {
  test("speeds are said in the unit of the page, with as many decimals", () => {
    inUnit("km/h");
    expect(inDisplayUnits("standing: 50.0 m/s, at most 0.5 m/s")).toBe(
      "standing: 180.0 km/h, at most 1.8 km/h",
    );
    expect(inDisplayUnits("+9.0 m/s, at most +5.0 m/s")).toBe("+32.4 km/h, at most +18.0 km/h");
    expect(inDisplayUnits("-2.5 m/s")).toBe("\u22129.0 km/h");
    expect(inDisplayUnits("limit 60 m/s")).toBe("limit 216 km/h");
    inUnit("m/s");
    expect(inDisplayUnits("50.0 m/s")).toBe("50.0 m/s");
  });
  test("what is no speed stays as it is, but for the sign of a degree", () => {
    expect(inDisplayUnits("2.5 m/s^2 and 3 m/s\u00b2, 12 m/song")).toBe(
      "2.5 m/s^2 and 3 m/s\u00b2, 12 m/song",
    );
    expect(inDisplayUnits("29.0 degC, 79.0 degC needed")).toBe("29.0 \u00b0C, 79.0 \u00b0C needed");
    expect(inDisplayUnits("")).toBe("");
  });
});

describe("a quantity", () => {
  test("has its unit, and speeds the page's", () => {
    expect(quantityText(1.6, "s")).toBe("1.60 s");
    expect(quantityText(12, "ticks")).toBe("12 ticks");
    expect(quantityText(0.0123, "rad")).toBe("0.012 rad");
    expect(quantityText(10, "m/s")).toBe("22.4 mph");
  });
  test("is nothing where there is none", () => {
    for (const none of [null, undefined, NaN, Infinity]) expect(quantityText(none, "s")).toBe("");
  });
});

describe("gates", () => {
  const gate = (more: Partial<Gate>): Gate => ({ name: "x", ok: false, text: "", ...more });
  test("say their value by name, else as a number with its unit, else that there is none", () => {
    expect(gateValueText(gate({ value: 4, word: "GREEN" }))).toBe("GREEN");
    expect(gateValueText(gate({ value: 29, unit: "degC", word: "" }))).toBe("29 \u00b0C");
    expect(gateValueText(gate({ value: 9, unit: "m/s" }))).toBe("20.1 mph");
    for (const value of [null, undefined, NaN]) {
      expect(gateValueText(gate({ value, unit: "m/s" }))).toBe("no data");
    }
  });
  test("are overridden by a reason, by a second person where there are tokens, some never", () => {
    const shut = [gate({ can_be_overridden: true })];
    const never = [...shut, gate({ name: "link", can_be_overridden: false })];
    const both = { reason: "dry", token: "t" };
    expect(overrideWants(shut, { reason: " ", token: "t" }, true)).toContain("reason");
    expect(overrideWants(shut, { reason: "dry", token: " " }, true)).toContain("second person");
    expect(overrideWants(shut, { reason: "dry", token: "" }, false)).toBe("");
    expect(overrideWants(shut, both, true)).toBe("");
    expect(overrideWants(never, both, true)).toBe("never overridden: link");
  });
});

describe("choices", () => {
  const info = (more: Partial<CommandInfo>): CommandInfo => ({
    ...{ name: "x", unit: "", min: 0, max: 9, resolution: 1, offered: true },
    ...{ time_to_live_ms: 2000, needs_authority: true },
    ...more,
  });
  test("are the named values, and of a set its bits", () => {
    expect(choicesOf(info({ labels: ["-", "reset"] }))).toEqual([{ value: 1, name: "reset" }]);
    expect(choicesOf(info({ labels: ["a", "b", "c"], unit: "bits" })).map((c) => c.value)).toEqual([
      1, 2, 4,
    ]);
    expect(choicesOf(info({ labels: null }))).toEqual([]);
  });
  test("of flags have the flag's colour", () => {
    expect(colourOfFlag("WAVING GREEN")).toBe("green");
    expect(colourOfFlag("none")).toBe("none");
  });
});

describe("a base", () => {
  test("is here, silent, gone; a page that has just opened waits for it", () => {
    expect(presenceOf(true, 10, 60_000)).toBe("here");
    expect(presenceOf(true, kSilentMs + 1, 60_000)).toBe("silent");
    expect(presenceOf(true, kGoneMs + 1, 60_000)).toBe("gone");
    expect(presenceOf(false, 10, 60_000)).toBe("gone");
    expect(presenceOf(false, Infinity, kOpeningMs - 1)).toBe("here");
    expect(presenceOf(false, Infinity, kOpeningMs + 1)).toBe("gone");
    expect(presenceOf(false, 10, kOpeningMs - 1)).toBe("gone");
  });
});
