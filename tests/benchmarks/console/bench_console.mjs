/**
 * How fast the base station is, from the radio's socket to the operator's eye and back, with eight
 * consoles on a car that says all it can. Real processes and a real browser in real time: other
 * work on the machine shows in the figures, so the best of five blocks counts (blocks.mjs). The
 * processor time of the base is weighed beside the reference unit of tests/benchmarks/cost.
 *
 *   node bench_console.mjs [--json FILE]   exit code 1 when a gate is missed
 *
 * PITWALL_BASE, PITWALL_CAR and PITWALL_PULSE name the programs.
 */
// SPDX-License-Identifier: Apache-2.0
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { kRoot } from "../../system/console/packages.mjs";
import { happenings, quantileOf, rateOf, windows, withDelays, worst } from "./blocks.mjs";
import { judged } from "./gates.mjs";
import { pixelFigures } from "./pixels.mjs";
import { eventually, now, pause, ReferencePulse, Rig, Viewer } from "./rig.mjs";

const kClients = 8;
const kSettleMs = 3000;
/** Of each block. */
const kWindows = 2;
const kStops = 20;
const kSilences = 2;
const kPerSecond = 1000;
/** Of the car; and how often all of them come in. Consoles are shown 25 pictures a second of it. */
const kFields = 300;
const kRate = 50;
const kPictures = 25;
/** Pictures in which nothing of a field is new, as the two rates are not in step. */
const kInStep = 0.98;
const kLookBackS = 3;

/** Packet to WebSocket, and the base's share of a core meanwhile. */
async function listen(gates, rig, viewers, pulse) {
  await pause(kSettleMs);
  const first = rig.left.length;
  const blocks = await windows(kWindows, () => ({
    busy: rig.busyMs(),
    told: viewers.reduce((sum, viewer) => sum + viewer.entries, 0),
  }));
  const left = rig.left.slice(first, -2);
  const late = withDelays(
    blocks,
    left,
    viewers.map(({ seen }) => seen),
  );
  gates.needBest(
    `changed values told to each console at ${kPictures} Hz`,
    blocks,
    (parts) => (rateOf("told")(parts) / kClients) * kPerSecond,
    kFields * kPictures * kInStep,
    "/s",
  );
  gates.sayBest("packet to WebSocket, p50", late, quantileOf(0.5), "ms");
  gates.askBest("packet to WebSocket, p99", late, quantileOf(0.99), 8, "ms");
  const share = (parts) => rateOf("busy")(parts) * 100;
  gates.sayBest(`base with ${kClients} consoles`, blocks, share, "% of a core");
  gates.askBest(
    "the same on the reference machine",
    blocks.map((parts) =>
      parts.map((part) => ({ ...part, busy: part.busy / pulse.times(part.from, part.to) })),
    ),
    share,
    10,
    "% of a core",
  );
}

/** Changes of each field of the car in the last seconds, by the base's own history of it. */
async function changesOf(ids, viewer) {
  await pause((kLookBackS + 1) * kPerSecond);
  viewer.histories.clear();
  const from = kLookBackS + 1 + 1 / kRate; // one packet more, for the first change to be one
  for (const id of ids) {
    viewer.say({ type: "history", field: id, from_s: from, to_s: 1, points: 20_000 });
  }
  await eventually("every history", () => viewer.histories.size === ids.length, 20_000);
  return [...viewer.histories.values()].map(
    (values) => values.filter((value, i) => Math.abs(value - values[i - 1]) > 0).length,
  );
}

/** What came in of the car. */
async function arrivals(gates, rig, viewer) {
  const ofCar = rig.fields.filter(({ path }) => !/^(link|derived|base)\./.test(path));
  const ids = ofCar.map(({ id }) => id);
  const looks = await happenings(1, () => changesOf(ids, viewer));
  // Of one look back: endless is one that was waited for in vain.
  const counts = (parts) => (parts[0]?.values ?? []).filter(Number.isFinite);
  const steady = (parts) =>
    counts(parts).filter((count) => count > 0.9 * kLookBackS * kRate).length;
  const come = (parts) => counts(parts).reduce((all, count) => all + count, 0) / kLookBackS;
  gates.needBest("fields of the car that change in every packet", looks, steady, kFields, "");
  gates.needBest("changed values that come in", looks, come, kFields * kRate, "/s");
}

/** ms from what the console says to the datagram at the car, at any time within a slot. */
async function stopOnce(rig, operator) {
  await pause(100 + 40 * Math.random());
  const before = rig.stops.length;
  const pressed = now();
  operator.say({ type: "stop", kind: "emergency" });
  await eventually("a stop at the car", () => rig.stops.length > before);
  const took = rig.stops[before].at - pressed;
  await pause(60);
  await eventually("its release", () => {
    operator.say({ type: "release_stop" });
    return pause(40).then(() => rig.stops.at(-1).level === 0);
  });
  return took;
}

async function stop(gates, rig, operator) {
  operator.say({ type: "authority", do: "take" });
  const renewing = setInterval(() => operator.say({ type: "authority", do: "renew" }), kPerSecond);
  const took = await happenings(kStops, () => stopOnce(rig, operator));
  clearInterval(renewing);
  gates.sayBest("emergency stop, console to car, p50", took, quantileOf(0.5), "ms");
  gates.askBest("emergency stop, console to car, p99", took, quantileOf(0.99), 10, "ms");
}

/** ms from the last packet of a car that falls silent until a console is told. */
async function silenceOnce(rig, viewer) {
  await eventually("a live link", () => /good|degraded/.test(viewer.linkStates.at(-1)?.state));
  await pause(kPerSecond + 100 * Math.random());
  const asked = now();
  rig.programs.car.kill("SIGSTOP");
  try {
    const lost = await eventually("the loss", () =>
      viewer.linkStates.find(({ state, at }) => state === "lost" && at > asked),
    );
    return lost.at - rig.newest.at;
  } finally {
    rig.programs.car.kill("SIGCONT");
    await pause(kPerSecond);
  }
}

async function silence(gates, rig, viewer) {
  const took = await happenings(kSilences, () => silenceOnce(rig, viewer));
  gates.askBest("link loss told to consoles, worst", took, worst, 500, "ms");
}

/** What a browser loads, gzipped; the build's own account of it. */
function bundle(gates) {
  const said = execFileSync(process.execPath, [join(kRoot, "basestation/console/size.mjs")], {
    encoding: "utf8",
  });
  gates.ask(
    "bundle, gzipped",
    Number(/(\d+) bytes gzipped in all/.exec(said)[1]) / 1024,
    120,
    "KB",
  );
}

async function pixels(gates, rig) {
  const { drawn, lost } = await pixelFigures(rig);
  gates.sayBest("packet to pixel, critical field, p50", drawn, quantileOf(0.5), "ms");
  gates.askBest("packet to pixel, critical field, p95", drawn, quantileOf(0.95), 100, "ms");
  gates.askBest("packet to pixel, critical field, worst", drawn, worst, 200, "ms");
  gates.askBest("link loss on the screen, worst", lost, worst, 500, "ms");
}

async function measure(gates) {
  const rig = new Rig();
  const pulse = new ReferencePulse();
  try {
    await rig.start(600);
    console.log(`${kClients} consoles on ${rig.fields.length} fields`);
    const viewers = await Promise.all(
      Array.from({ length: kClients }, () => Viewer.open(rig.address, new Viewer(rig))),
    );
    await listen(gates, rig, viewers, pulse);
    await arrivals(gates, rig, viewers[0]);
    await stop(gates, rig, viewers[0]);
    await silence(gates, rig, viewers[0]);
    for (const viewer of viewers) viewer.close();
    await pixels(gates, rig);
    bundle(gates);
  } finally {
    pulse.close();
    await rig.close();
  }
}

await judged("console", measure);
