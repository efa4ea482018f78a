/**
 * What an operator changes and hears: the lines of a review, and which alarm sounds.
 */
// SPDX-License-Identifier: Apache-2.0
import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { newcomer } from "../src/frame/tones";
import { changes } from "../src/pages/alarms/settings";
import { kPriorities, needsEyes } from "../src/view/alarm_order";
import type { Alarm } from "../src/wire/messages";

const alarm = (id: number, priority: Alarm["priority"], state: Alarm["state"]): Alarm => ({
  id,
  key: `k${id}`,
  text: "",
  response: "",
  priority,
  state,
  since_ms: 0,
  count: 1,
  first_up: false,
});

describe("a review", () => {
  test("what was typed and typed back again is no change", () => {
    expect(changes({ limit: 0.08 }, {})).toEqual([]);
    expect(changes({ limit: 0.08 }, { limit: "0.08" })).toEqual([]);
    expect(changes({ limit: 0.08 }, { limit: "0.1" })).toEqual(["limit: 0.08 \u2192 0.1"]);
    expect(changes({}, { bad_low: "11" })).toEqual(["bad low: \u2013 \u2192 11"]);
    expect(changes({ bad_low: 11 }, { bad_low: "" })).toEqual(["bad low: 11 \u2192 \u2013"]);
  });
});

describe("tones", () => {
  const anAlarm = fc.record({
    id: fc.integer({ min: 1, max: 30 }),
    priority: fc.constantFrom(...kPriorities),
    state: fc.constantFrom("unack", "acked", "rtn_unack", "latched" as const),
  });
  test("the loudest of those that are new and unseen, and of no other", () => {
    fc.assert(
      fc.property(
        fc.uniqueArray(anAlarm, { selector: (a) => a.id }),
        fc.uniqueArray(fc.integer({ min: 1, max: 30 })),
        (list, known) => {
          const active = list.map((a) => alarm(a.id, a.priority, a.state as Alarm["state"]));
          const heard = newcomer(new Set(known), active);
          const fresh = active.filter((a) => needsEyes(a) && !known.includes(a.id));
          if (heard === null) expect(fresh).toEqual([]);
          else {
            const ranks = fresh.map((a) => kPriorities.indexOf(a.priority));
            expect(kPriorities.indexOf(heard)).toBe(Math.min(...ranks));
          }
        },
      ),
    );
  });
});
