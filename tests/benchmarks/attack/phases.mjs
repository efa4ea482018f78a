/**
 * The attacks, in the order in which they are measured: what the attacker is told, what is started
 * again meanwhile, and which alarms of the base the operator must then have. Two attacks that raise
 * the same alarm are kept apart, so that it has gone before it must come again.
 */
// SPDX-License-Identifier: Apache-2.0
import { kDelayMs } from "./pair.mjs";
import { kWebPhases } from "./web_phases.mjs";

/** Keys of the alarms in the base's alarm table. */
export const kAlarms = {
  wrongKey: "wrong_key",
  sealedOrSigned: "mode_mismatch",
  refused: "refused_at_rate",
  secondPeer: "second_peer",
  openings: "replayed_openings",
  relay: "relay",
};
const { wrongKey, sealedOrSigned, refused, secondPeer, openings, relay } = kAlarms;

const kOne = 1;
const kMany = 30;
/** Relative to the honest radio. */
const kLaterMs = kDelayMs + 1;
const kFasterMs = kDelayMs - 1;

/** A link that was led away is back by then. */
const kLinkBackMs = 2000;

/**
 * attack          command for the attacker; `again`: given a second time, halfway
 * first_after_ms  from the attack to the press that follows it
 * rogue           another car that knocks: whose keys, and whether it is set to signed packets
 * restart         base, car or both (car, then base), at the beginning and halfway
 * rate            datagrams a second that the attacker must reach
 * alarms          that must come within 2 s
 * steady          the packet rates must keep their share of the twin's
 * gap_ms          worst gap of the link that is allowed
 */
export const kPhases = [
  { name: "quiet", alarms: [], steady: true },
  {
    name: "1 opening at 100/s",
    attack: `openings 1 100 ${kOne}`,
    rate: 100,
    alarms: [openings],
    steady: true,
  },
  {
    name: "forged to the base at 50,000/s",
    attack: `forged base 50000 ${kMany}`,
    rate: 50_000,
    alarms: [refused],
    steady: true,
  },
  {
    name: "1 opening at 500/s, base restarted",
    attack: `openings 1 500 ${kOne}`,
    rate: 500,
    restart: "base",
    alarms: [openings],
  },
  { name: "a car with other keys knocks", rogue: { keys: "other" }, alarms: [wrongKey] },
  {
    name: "64 openings at 500/s",
    attack: `openings 64 500 ${kMany}`,
    rate: 500,
    alarms: [openings],
    steady: true,
  },
  {
    name: "forged to the car at 50,000/s",
    attack: `forged car 50000 ${kMany}`,
    rate: 50_000,
    alarms: [refused],
    steady: true,
  },
  {
    name: "1,000 openings at 100/s, base restarted",
    attack: `openings 1000 100 ${kOne}`,
    rate: 100,
    restart: "base",
    alarms: [openings],
  },
  {
    name: "a relay 1 ms faster for 1 s, then silent",
    attack: `relay ${kFasterMs} 1000`,
    again: true,
    first_after_ms: 1200,
    alarms: [relay],
    gap_ms: kLinkBackMs,
  },
  {
    name: "1 opening at 10,000/s, car restarted",
    attack: `openings 1 10000 ${kMany}`,
    rate: 10_000,
    restart: "car",
    alarms: [openings],
  },
  { name: "a signed car knocks", rogue: { keys: "own", signed: true }, alarms: [sealedOrSigned] },
  {
    name: "1,000 openings at 10,000/s",
    attack: `openings 1000 10000 ${kMany}`,
    rate: 10_000,
    alarms: [openings],
    steady: true,
  },
  {
    name: "the whole capture at 5,000/s",
    attack: `capture 5000 ${kMany}`,
    rate: 5_000,
    alarms: [refused],
    steady: true,
  },
  {
    name: "64 openings at 10,000/s, base restarted",
    attack: `openings 64 10000 ${kMany}`,
    rate: 10_000,
    restart: "base",
    alarms: [openings],
  },
  {
    name: "every datagram again, 1 ms later",
    attack: `copies ${kLaterMs * 1000}`,
    alarms: [relay],
    steady: true,
  },
  {
    name: "64 openings at 100/s, car restarted",
    attack: `openings 64 100 ${kMany}`,
    rate: 100,
    restart: "car",
    alarms: [openings],
  },
  { name: "a second car with the same keys", rogue: { keys: "own" }, alarms: [secondPeer] },
  {
    name: "1,000 openings at 500/s, car restarted",
    attack: `openings 1000 500 ${kMany}`,
    rate: 500,
    restart: "car",
    alarms: [openings],
  },
  {
    name: "old sessions at 5,000/s, both restarted",
    attack: `old 5000 ${kMany}`,
    rate: 5_000,
    restart: "both",
    alarms: [refused],
  },
  ...kWebPhases,
];
