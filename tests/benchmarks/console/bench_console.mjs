/**
 * How fast the base station is, from the radio's socket to the operator's eye and back, with eight
 * consoles on a car that says all it can. Real processes and a real browser in real time: other
 * work on the machine shows in the figures. What its host takes away does not: that time is passed
 * over, and how often is printed.
 *
 *   node bench_console.mjs [--json FILE]   exit code 1 when a gate is missed
 *
 * PITWALL_BASE and PITWALL_CAR name the programs.
 */
// SPDX-License-Identifier: Apache-2.0
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { kRoot } from "../../system/console/packages.mjs";
import { judged } from "./gates.mjs";
import { pixelFigures } from "./pixels.mjs";
import { Quiet, leftAlone } from "./quiet.mjs";
import { Rig, Viewer, eventually, now, pause, quantile } from "./rig.mjs";

const kClients = 8;
const kSettleMs = 3000;
const kWindows = 10;
const kStops = 100;
const kSilences = 5;
const kPerSecond = 1000;
/** Of the car; and how often all of them come in. Consoles are shown 25 pictures a second of it. */
const kFields = 300;
const kRate = 50;
const kPictures = 25;
/** Pictures in which nothing of a field is new, as the two rates are not in step. */
const kInStep = 0.98;
const kLookBackS = 3;

const passedOver = (wanted) => `passed over, the host being busy, for ${wanted}`;

/** Packet to WebSocket, and the base's share of a core meanwhile. */
async function listen(gates, rig, viewers) {
  await pause(kSettleMs);
  const first = rig.left.length;
  const entries = viewers.reduce((sum, viewer) => sum + viewer.entries, 0);
  const from = now();
  const quiet = await Quiet.watch(kWindows, () => rig.busyMs());
  const told = viewers.reduce((sum, viewer) => sum + viewer.entries, 0) - entries;
  const lasted = now() - from;
  const left = rig.left.slice(first, -2);
  const late = viewers.flatMap((viewer) => quiet.delays(left, viewer.seen));
  gates.say(`windows ${passedOver(kWindows)}`, quiet.disturbed, "");
  gates.need(
    `changed values told to each console at ${kPictures} Hz`,
    (told / kClients / lasted) * kPerSecond,
    kFields * kPictures * kInStep,
    "/s",
  );
  gates.say("packet to WebSocket, p50", quantile(late, 0.5), "ms");
  gates.ask("packet to WebSocket, p99", quantile(late, 0.99), 8, "ms");
  gates.ask(`base with ${kClients} consoles`, quiet.share * 100, 10, "% of a core");
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
  const { results, disturbed } = await leftAlone("looks back", 1, () => changesOf(ids, viewer));
  const [changes] = results;
  const steady = changes.filter((count) => count > 0.9 * kLookBackS * kRate);
  const sum = changes.reduce((all, count) => all + count, 0);
  gates.say(`looks back ${passedOver(1)}`, disturbed, "");
  gates.need("fields of the car that change in every packet", steady.length, kFields, "");
  gates.need("changed values that come in", sum / kLookBackS, kFields * kRate, "/s");
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
  const { results: took, disturbed } = await leftAlone("stops", kStops, () =>
    stopOnce(rig, operator),
  );
  clearInterval(renewing);
  gates.say(`stops ${passedOver(kStops)}`, disturbed, "");
  gates.say(`${kStops} emergency stops, console to car, p50`, quantile(took, 0.5), "ms");
  gates.ask("emergency stop, console to car, p99", quantile(took, 0.99), 10, "ms");
}

/** ms from the last packet of a car that falls silent until a console is told. */
async function silenceOnce(rig, viewer) {
  await eventually("a live link", () => /good|degraded/.test(viewer.linkStates.at(-1)?.state));
  await pause(kPerSecond + 100 * Math.random());
  const asked = now();
  rig.programs.car.kill("SIGSTOP");
  const lost = await eventually("the loss", () =>
    viewer.linkStates.find(({ state, at }) => state === "lost" && at > asked),
  );
  const took = lost.at - rig.newest.at;
  rig.programs.car.kill("SIGCONT");
  await pause(kPerSecond);
  return took;
}

async function silence(gates, rig, viewer) {
  const { results: took, disturbed } = await leftAlone("losses of the link", kSilences, () =>
    silenceOnce(rig, viewer),
  );
  gates.say(`losses ${passedOver(kSilences)}`, disturbed, "");
  gates.ask("link loss told to consoles, worst", Math.max(...took), 500, "ms");
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
  const figures = await pixelFigures(rig);
  gates.say("windows and losses of the page passed over", figures.disturbed, "");
  gates.say("packet to pixel, critical field, p50", quantile(figures.drawn, 0.5), "ms");
  gates.ask("packet to pixel, critical field, p95", quantile(figures.drawn, 0.95), 100, "ms");
  gates.ask("packet to pixel, critical field, worst", Math.max(...figures.drawn), 200, "ms");
  gates.ask("link loss on the screen, worst", Math.max(...figures.lost), 500, "ms");
}

async function measure(gates) {
  const rig = new Rig();
  try {
    await rig.start(600);
    console.log(`${kClients} consoles on ${rig.fields.length} fields`);
    const viewers = await Promise.all(
      Array.from({ length: kClients }, () => Viewer.open(rig.address, new Viewer(rig))),
    );
    await listen(gates, rig, viewers);
    await arrivals(gates, rig, viewers[0]);
    await stop(gates, rig, viewers[0]);
    await silence(gates, rig, viewers[0]);
    for (const viewer of viewers) viewer.close();
    await pixels(gates, rig);
    bundle(gates);
  } finally {
    await rig.close();
  }
}

await judged("console", measure);
