/**
 * The wire: what the base says is read as PROTOCOL.md has it, and whatever else comes is refused
 * whole.
 */
// SPDX-License-Identifier: Apache-2.0
import fc from "fast-check";
import { afterEach, describe, expect, test, vi } from "vitest";
import {
  ageCode,
  history,
  kFresh,
  snapshot,
  statusByte,
} from "../../../tests/system/console/wire.mjs";
import { ageMs, kAgeNever } from "../src/wire/age";
import { readHead, readHistory, readSnapshot } from "../src/wire/frame";
import { BaseSocket } from "../src/wire/socket";
import {
  Judgement,
  Quality,
  judgementOf,
  kJudgementNames,
  kNeverStatus,
  kQualityNames,
  qualityOf,
  saysUnknown,
} from "../src/wire/status";

const viewOf = (bytes: Uint8Array) =>
  new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

describe("age code", () => {
  test("has the steps of the contract", () => {
    expect([0, 99, 100, 189, 190, 249, 250, 254].map(ageMs)).toEqual([
      0, 990, 1000, 9900, 10_000, 69_000, 70_000, 310_000,
    ]);
    expect(kAgeNever).toBe(255);
    expect(ageMs(255)).toBe(Infinity);
  });

  test("never grows younger with its code", () => {
    for (let code = 1; code <= 255; ++code) expect(ageMs(code)).toBeGreaterThan(ageMs(code - 1));
  });

  test("of a time is at most one step below it", () => {
    fc.assert(
      fc.property(fc.double({ min: 0, max: 69_999, noNaN: true }), (ms) => {
        const step = ms < 1000 ? 10 : ms < 10_000 ? 100 : 1000;
        const back = ageMs(ageCode(ms));
        expect(back).toBeLessThanOrEqual(ms + 1e-9);
        expect(ms - back).toBeLessThan(step + 1e-6);
      }),
    );
  });
});

describe("status", () => {
  test("is the byte of the contract, bit by bit", () => {
    expect([Quality.fresh, Quality.late, Quality.stale, Quality.never]).toEqual([0, 1, 2, 3]);
    expect([Judgement.none, Judgement.good, Judgement.warning, Judgement.bad]).toEqual([
      0, 1, 2, 3,
    ]);
    expect(kQualityNames).toEqual(["fresh", "late", "stale", "never"]);
    expect(kJudgementNames).toEqual(["none", "good", "warning", "bad"]);
    expect(kNeverStatus).toBe(3);
    for (let quality = 0; quality < 4; ++quality)
      for (let judgement = 0; judgement < 8; ++judgement)
        for (const unknown of [0, 1]) {
          const byte = quality | (judgement << 2) | (unknown << 5);
          expect(qualityOf(byte)).toBe(quality);
          expect(saysUnknown(byte)).toBe(unknown === 1);
          expect(saysUnknown(byte | 0xc0)).toBe(unknown === 1);
          expect(judgementOf(byte)).toBe(quality < 2 && judgement <= 3 ? judgement : 0);
        }
  });

  test("a stale or never heard value has no judgement, whatever its byte says", () => {
    for (let byte = 0; byte < 64; ++byte) {
      const judged = judgementOf(byte);
      if (qualityOf(byte) >= Quality.stale) expect(judged).toBe(Judgement.none);
      expect(judged).toBeLessThanOrEqual(Judgement.bad);
      expect(saysUnknown(byte)).toBe(byte >= 32);
    }
  });
});

describe("snapshot", () => {
  const entry = fc.record({
    id: fc.integer({ min: 0, max: 65_535 }),
    status: fc.integer({ min: 0, max: 63 }),
    age: fc.integer({ min: 0, max: 255 }),
    value: fc.float(),
  });

  test("is read as it was written", () => {
    fc.assert(
      fc.property(fc.array(entry, { maxLength: 40 }), (entries) => {
        const view = viewOf(snapshot(entries, { timeMs: 123_456.789, sequence: 9, dropped: 2 }));
        const head = readHead(view)!;
        expect(head).toMatchObject({ count: entries.length, sequence: 9, dropped: 2, car: 7 });
        expect(head.timeMs).toBeCloseTo(123_456.789, 5);
        const read: unknown[] = [];
        const good = readSnapshot(view, head, (id, status, age, value) =>
          read.push({ id, status, age, value }),
        );
        expect(good).toBe(true);
        expect(read).toEqual(entries);
      }),
    );
  });

  test("that is cut, too long or of another version is refused, and hands over nothing", () => {
    const bytes = new Uint8Array(
      snapshot([{ id: 1, status: statusByte(kFresh), age: 1, value: 2 }], { timeMs: 1 }),
    );
    const refused = (raw: Uint8Array) => {
      const head = readHead(viewOf(raw));
      return (
        head === null ||
        !readSnapshot(viewOf(raw), head, () => {
          throw Error("handed over");
        })
      );
    };
    for (let length = 0; length < bytes.length; ++length) {
      expect(refused(bytes.slice(0, length))).toBe(true);
    }
    expect(refused(new Uint8Array([...bytes, 0]))).toBe(true);
    for (const [at, value] of [
      [0, 4],
      [0, 0],
      [1, 2],
    ]) {
      const other = bytes.slice();
      other[at] = value;
      expect(refused(other)).toBe(true);
    }
  });
});

test("a history is read as it was written, and refused when it is cut", () => {
  const points = [
    { timeS: 1.5, value: -2, quality: 0 },
    { timeS: 1.6, value: 3, quality: 2 },
  ];
  const bytes = new Uint8Array(history(17, points, { timeMs: 1 }));
  const read = readHistory(viewOf(bytes))!;
  expect(read.field).toBe(17);
  expect([...read.timeS]).toEqual([1.5, 1.6]);
  expect([...read.value]).toEqual([-2, 3]);
  expect([...read.quality]).toEqual([0, 2]);
  for (let length = 0; length < bytes.length; ++length) {
    expect(readHistory(viewOf(bytes.slice(0, length)))).toBeNull();
  }
});

describe("the socket", () => {
  class RefusedSocket {
    static opened: RefusedSocket[] = [];
    onclose: (() => void) | null = null;
    constructor() {
      RefusedSocket.opened.push(this);
    }
  }

  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  test("asks a base that is away again within a second, for as long as it is away", () => {
    vi.useFakeTimers();
    vi.stubGlobal("WebSocket", RefusedSocket);
    const losses = vi.fn();
    const nothing = () => undefined;
    const listener = { opened: nothing, text: nothing, binary: nothing, unreadable: nothing };
    new BaseSocket("ws://base/ws", { ...listener, closed: losses }).connect();
    for (let tries = 1; tries < 20; ++tries) {
      expect(RefusedSocket.opened.length).toBe(tries);
      RefusedSocket.opened.at(-1)!.onclose!();
      expect(losses).toHaveBeenCalledTimes(tries);
      expect(RefusedSocket.opened.length, "not at once").toBe(tries);
      vi.advanceTimersByTime(1000);
    }
  });
});
