/**
 * Radio and consoles under attack: the real base, the real car at standstill, a radio path between
 * them and an attacker beside it who receives a copy of everything, crowds at the console, and too
 * little memory, disk and descriptors; and the same without any of it, the twin, at the same time.
 * All on loopback, in real time, alone on the machine, with mounts of its own.
 *
 *   node long_attack.mjs [--json FILE]   exit code 1 when a gate is missed
 *
 * PITWALL_ATTACK_MINUTES is its length (14), PITWALL_ATTACK_ONLY a regular expression for names of
 * phases; PITWALL_BASE and PITWALL_VEHICLE name the programs, PITWALL_ATTACK_PROGRAMS the folder of
 * the attack's own.
 */
// SPDX-License-Identifier: Apache-2.0
import { takenMs } from "../../support/machine.mjs";
import { judged } from "../console/gates.mjs";
import { now, pause } from "../console/rig.mjs";
import { Meter } from "./meter.mjs";
import { kAlarms, kPhases } from "./phases.mjs";
import { Rig } from "./rig.mjs";
import { head, lines } from "./table.mjs";

const kMinutes = Number(process.env.PITWALL_ATTACK_MINUTES ?? 14);
const kOnly = new RegExp(process.env.PITWALL_ATTACK_ONLY ?? ".");
const kFullMinutes = 14;
const kFullPresses = 20;
const kLeastPresses = 4;
const kPresses = Math.max(
  kLeastPresses,
  Math.min(kFullPresses, Math.round((kFullPresses * kMinutes) / kFullMinutes)),
);
const kPhaseMs = (kMinutes * 60_000) / kPhases.length;
/** Before and after the presses of a phase. */
const kAroundMs = 4000;
const kSpacingMs = Math.max(600, (kPhaseMs - kAroundMs) / kPresses);
const kJitterMs = 100;
const kPressLimitMs = 15_000;
const kReleaseLimitMs = 5000;
const kLinkLimitMs = 20_000;
/** What late presses may add to a phase before it is over. */
const kOvertimeMs = 30_000;
const kBeforeRestartMs = 1000;
const kQuietLimitMs = 20_000;
/** Of a processor, by the host, in one press: it does not count. See console/blocks.mjs. */
const kTakenMs = 10;

const kStopLaterMs = 100;
const kAlarmMs = 2000;
/** How much later than at the twin an operator who comes is there. */
const kComesLaterMs = 1000;
const kComesLimitMs = 10_000;
const kLinkLaterMs = 2000;
const kSteadyShare = 0.9;
const kRateShare = 0.8;
const kBaseGrowsMb = 8;
const kCarGrowsMb = 4;

async function waitFor(limitMs, test) {
  for (const end = now() + limitMs; now() < end; await pause(20)) {
    if (test()) return true;
  }
  return test();
}

/** Links whole, nothing latched, no alarm standing that this phase must raise. */
async function settle(rig, phase, record) {
  if (phase.fresh) await rig.restart("base", kLinkLimitMs);
  rig.acknowledge();
  await waitFor(kAlarmMs, () => rig.linked);
  for (const pair of rig.pairs) {
    if (await waitFor(kAlarmMs, () => pair.linked)) continue;
    record.healed.push(pair.name);
    await rig.heal(pair);
  }
  await rig.release(kReleaseLimitMs);
  const { attacked } = rig;
  const gone = () => !rig.standing(attacked).some((key) => phase.alarms.includes(key));
  record.stood = !(await waitFor(kQuietLimitMs, () => (rig.acknowledge(), gone())));
}

/** What a phase does twice: before its first press and before the one in the middle. */
async function stir(rig, phase, record) {
  const first = record.stirred === 0;
  record.stirred += 1;
  if (phase.again && !first) rig.again(phase);
  if (phase.first_after_ms) await pause(phase.first_after_ms);
  if (phase.restart && first) await pause(kBeforeRestartMs);
  if (!phase.restart) return;
  const pairs = await rig.restart(phase.restart, kLinkLimitMs);
  record.links.push(pairs);
  // A car that starts has no link yet, with or without an attack: that time is judged by itself.
  if (phase.restart !== "base") await Promise.all(pairs.map(({ linked }) => linked));
}

/** One press in both pairs at the same moment; true where it counts. */
async function pressOnce(rig, record) {
  const taken = takenMs();
  const took = await Promise.all(rig.pairs.map((pair) => pair.press(kPressLimitMs)));
  const counts = takenMs() - taken <= kTakenMs;
  if (counts) record.meters.forEach((meter, i) => meter.stops.push(took[i]));
  else record.passedOver += 1;
  return counts;
}

/** All presses of a phase; without the rest where the stops come or go too late for all. */
async function press(rig, phase, record) {
  const start = now();
  const half = Math.floor(kPresses / 2);
  for (let n = 0, tries = 0; n < kPresses && tries < 2 * kPresses; ++tries) {
    if (now() > start + kPhaseMs + kOvertimeMs) return;
    if (record.stirred === 0 || (record.stirred === 1 && n === half)) {
      await stir(rig, phase, record);
    }
    const due = start + n * kSpacingMs + kJitterMs * Math.random();
    await pause(Math.max(0, due - now()));
    if (await pressOnce(rig, record)) n += 1;
    while (!(await rig.release(kReleaseLimitMs))) {
      if (now() > start + kPhaseMs + kOvertimeMs) return;
    }
  }
}

async function measure(rig, phase) {
  const record = { phase, healed: [], links: [], passedOver: 0, stirred: 0 };
  await settle(rig, phase, record);
  for (const pair of rig.pairs) pair.forget();
  record.meters = await Promise.all(rig.pairs.map((pair) => Meter.on(pair)));
  const before = phase.counts && (await rig.attacked.counts());
  record.begun = await rig.begin(phase);
  await press(rig, phase, record);
  if (phase.crowd) await visit(rig, phase, record);
  await waitFor(record.begun + (phase.alarm_ms ?? kAlarmMs) - now(), () => false);
  record.attackMs = now() - record.begun;
  record.traffic = await rig.end(phase);
  // Not before: a base that refuses clients refuses who asks for its counters, too.
  if (phase.counts) {
    const after = await rig.attacked.counts();
    record.refused = after.of(phase.counts) - before.of(phase.counts);
  }
  for (const meter of record.meters) await meter.end();
  record.linked = await Promise.all(
    record.links.map((pairs) => Promise.all(pairs.map(({ linked }) => linked))),
  );
  record.figures = record.meters.map((meter) => meter.figures());
  record.told = record.meters.map((meter) => meter.alarms(record.begun));
  record.events = record.meters.map((meter) => meter.events());
  return record;
}

/** What a crowd leaves to others, and what the base says of it. */
async function visit(rig, phase, record) {
  // Where the machine has nothing left, an operator who comes is refused as everybody.
  record.comes = phase.limit
    ? [0, 0]
    : await Promise.all(rig.pairs.map((pair) => pair.comes(kComesLimitMs)));
  record.open = rig.attacked.visitors.heard.open ?? 0;
  record.said = rig.attacked.programs.baseSaid;
}

/** Answered bytes for each byte of an attacker who proved nothing. */
const amplification = ({ bytes, answerBytes }) => (bytes > 0 ? answerBytes / bytes : 0);

function judgeAttack(gates, record) {
  const { phase, traffic, attackMs } = record;
  if (!phase.rate) return;
  const reached = (traffic.sent / attackMs) * 1000;
  gates.need(`${phase.name}: sent, of what it should`, reached / phase.rate, kRateShare, "");
  gates.ask(`${phase.name}: bytes back for each`, amplification(traffic), 1, "");
}

function judgeLink(gates, record) {
  const { phase, linked } = record;
  const [mine, its] = record.figures;
  if (phase.steady) {
    for (const way of ["down", "up"]) {
      const share = mine[`${way}_per_s`] / its[`${way}_per_s`];
      gates.need(`${phase.name}: packets ${way}, of the twin's`, share, kSteadyShare, "");
    }
  }
  for (const [attacked, twin] of linked) {
    gates.ask(`${phase.name}: link later than the twin's`, attacked - twin, kLinkLaterMs, "ms");
  }
  if (phase.gap_ms === undefined) return;
  for (const way of ["down", "up"]) {
    gates.ask(`${phase.name}: worst gap ${way}`, mine[`${way}_gap_ms`], phase.gap_ms, "ms");
  }
}

function judgeCrowd(gates, record) {
  const { phase, comes, open, said, refused } = record;
  if (!phase.crowd) return;
  const later = comes[0] - comes[1];
  gates.say(`${phase.name}: open at the end`, open, "");
  if (!phase.limit) {
    gates.ask(`${phase.name}: an operator comes later than the twin's`, later, kComesLaterMs, "ms");
  }
  if (phase.counts) gates.need(`${phase.name}: ${phase.counts}`, refused, 1, "");
  const all = phase.all_or_said && open >= phase.crowd.count;
  if (phase.says && !all) {
    gates.need(`${phase.name}: the cause is said`, Number(phase.says.test(said)), 1, "");
  }
}

function judge(gates, record) {
  const { phase, told, figures } = record;
  const [mine, its] = figures;
  const later = mine.stop_p99_ms - its.stop_p99_ms;
  gates.need(`${phase.name}: presses`, mine.stops, kPresses, "");
  gates.ask(
    `${phase.name}: stop later than the twin's, p99`,
    later,
    phase.later_ms ?? kStopLaterMs,
    "ms",
  );
  judgeCrowd(gates, record);
  judgeLink(gates, record);
  judgeAttack(gates, record);
  for (const key of phase.alarms) {
    const at = told[0].get(key) ?? Infinity;
    gates.ask(`${phase.name}: alarm ${key}`, at, phase.alarm_ms ?? kAlarmMs, "ms");
  }
  if (phase.alarms.length > 0 && !phase.crowd) {
    gates.need(`${phase.name}: events told`, record.events[0].length, 1, "");
  }
  const wrong = [...told[1].keys()].filter((key) => Object.values(kAlarms).includes(key));
  gates.ask(`${phase.name}: alarms of attacks at the twin`, wrong.length, 0, "");
  gates.ask(`${phase.name}: links dead before it`, record.healed.length, 0, "");
}

/** Of the attacks on the radio: a crowd of consoles takes what the base may use for them. */
function judgeMemory(gates, all) {
  const records = all.filter(({ phase }) => !phase.crowd);
  if (records.length === 0) return;
  const grown = (pair, what) => records.at(-1).figures[pair][what] - records[0].figures[pair][what];
  gates.ask(
    "memory of the base beyond the twin's",
    grown(0, "base_mb") - grown(1, "base_mb"),
    kBaseGrowsMb,
    "MB",
  );
  gates.ask(
    "memory of the car beyond the twin's",
    grown(0, "car_mb") - grown(1, "car_mb"),
    kCarGrowsMb,
    "MB",
  );
}

function tell(gates, rig, records) {
  for (const record of records) {
    rig.pairs.forEach(({ name }, i) =>
      gates.rows.push({
        name: `${record.phase.name}, ${name}`,
        ...record.figures[i],
        told: Object.fromEntries(record.told[i]),
        events: record.events[i],
      }),
    );
  }
  console.log("");
  for (const record of records) judge(gates, record);
}

await judged("attack", async (gates) => {
  const phases = kPhases.filter(({ name }) => kOnly.test(name));
  console.log(`${phases.length} phases, ${kPresses} presses each; every second line is the twin`);
  const rig = new Rig();
  for (const signal of ["SIGINT", "SIGTERM"]) {
    process.once(signal, () => rig.close().finally(() => process.exit(1)));
  }
  const records = [];
  try {
    await rig.start();
    console.log(head());
    for (const phase of phases) {
      records.push(await measure(rig, phase));
      console.log(lines(records.at(-1)).join("\n"));
    }
  } finally {
    // What was measured is judged, too, where a phase could not go on.
    await rig.close().finally(() => tell(gates, rig, records));
  }
  judgeMemory(gates, records);
});
