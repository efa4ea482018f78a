/**
 * Cost of attached tools for the console: packet to WebSocket, lost packets and the base's share of
 * a core, with every publisher on and one reader stopped, against the same base without publishers,
 * in turns within one run. Real processes in real time: other work on the machine shows in the
 * figures, so the best round counts, see console/blocks.mjs.
 *
 *   own_network.sh node bench_publishers.mjs [--json FILE]   exit code 1 when a gate is missed
 *
 * PITWALL_BASE and PITWALL_CAR name the programs.
 */
// SPDX-License-Identifier: Apache-2.0
import { execFileSync, spawn } from "node:child_process";
import { once } from "node:events";
import { createServer } from "node:net";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { kBlocks, quantileOf, rateOf, summary, windows, withDelays } from "../console/blocks.mjs";
import { judged } from "../console/gates.mjs";
import { eventually, now, pause, Rig, Viewer } from "../console/rig.mjs";

const kClients = 4;
const kSettleMs = 3000;
/** Of each round. */
const kWindows = 3;
const kReader = fileURLToPath(new URL("reader.mjs", import.meta.url));

async function freePort() {
  const server = createServer().listen(0, "127.0.0.1");
  await once(server, "listening");
  const { port } = server.address();
  await new Promise((done) => server.close(done));
  return port;
}

/** A Foxglove client in a process of its own. A team's runs elsewhere; here it gives way. */
async function reader(port) {
  const words = ["-n", "10", process.execPath, kReader, `ws://127.0.0.1:${port}`];
  const process_ = spawn("nice", words, { stdio: ["pipe", "pipe", "inherit"] });
  const lines = createInterface({ input: process_.stdout })[Symbol.asyncIterator]();
  await lines.next();
  return {
    process: process_,
    async had() {
      process_.stdin.write("\n");
      return (await lines.next()).value.match(/\d+/g).map(Number);
    },
  };
}

/** The publishers that this base has. */
function publisherFlags(port) {
  const help = execFileSync(process.env.PITWALL_BASE, ["--help"], { encoding: "utf8" });
  const flags = ["--foxglove", String(port), "--lcm"];
  if (/^\s+--ros\b/m.test(help)) flags.push("--ros");
  return flags;
}

/** The sum of the samples of a metric. */
async function metric(rig, name) {
  const text = await (await fetch(`${rig.address}/metrics`)).text();
  return text
    .split("\n")
    .filter((line) => line.startsWith(`${name}{`) || line.startsWith(`${name} `))
    .reduce((sum, line) => sum + Number(line.split(" ").at(-1)), 0);
}

async function attach(port) {
  const reads = await reader(port);
  const stopped = await reader(port);
  stopped.process.kill("SIGSTOP");
  return { reads, stopped };
}

/** One base: what its consoles saw in a while, and what it cost. */
async function listen(withPublishers) {
  const rig = new Rig();
  const port = withPublishers ? await freePort() : 0;
  let tools;
  try {
    await rig.start(600, ...(withPublishers ? publisherFlags(port) : []));
    const viewers = await Promise.all(
      Array.from({ length: kClients }, () => Viewer.open(rig.address, new Viewer(rig))),
    );
    await eventually("the car", () => rig.left.length > 10);
    if (withPublishers) tools = await attach(port);
    await pause(kSettleMs);
    const first = rig.left.length;
    const lost = await metric(rig, "pitwall_packets_lost_total");
    const had = tools ? (await tools.reads.had())[0] : 0;
    const from = now();
    const [parts] = await windows(kWindows, () => ({ busy: rig.busyMs() }), 1);
    const lasted = now() - from;
    const left = rig.left.slice(first, -2);
    const [late] = withDelays(
      [parts],
      left,
      viewers.map(({ seen }) => seen),
    );
    const figures = {
      late,
      lost: (await metric(rig, "pitwall_packets_lost_total")) - lost,
      dropped: viewers.reduce((sum, viewer) => sum + viewer.dropped, 0),
      posts: await metric(rig, "pitwall_web_posts_dropped_total"),
    };
    if (tools) {
      const [all, losses] = await tools.reads.had();
      figures.read = ((all - had) / lasted) * 1000;
      figures.losses = losses;
      figures.stopped = await metric(rig, "pitwall_publisher_dropped_total");
    }
    for (const viewer of viewers) viewer.close();
    return figures;
  } finally {
    for (const tool of Object.values(tools ?? {})) tool.process.kill("SIGKILL");
    await rig.close();
  }
}

const sum = (rounds, name) => rounds.reduce((total, round) => total + round[name], 0);
const late = (rounds) => rounds.map((round) => round.late);
const share = (parts) => rateOf("busy")(parts) * 100;
async function measure(gates) {
  const flags = publisherFlags(0).join(" ");
  console.log(`${kClients} consoles; publishers: ${flags}; one reader stopped`);
  const without = [];
  const all = [];
  for (let n = 0; n < kBlocks; ++n) {
    without.push(await listen(false));
    all.push(await listen(true));
  }
  const p50 = quantileOf(0.5);
  const p99 = quantileOf(0.99);
  gates.sayBest("packet to WebSocket, p50, without publishers", late(without), p50, "ms");
  gates.sayBest("packet to WebSocket, p50, with all", late(all), p50, "ms");
  gates.sayBest("packet to WebSocket, p99, without publishers", late(without), p99, "ms");
  gates.askBest("packet to WebSocket, p99, with all", late(all), p99, 8, "ms");
  const cost = summary(late(all), p99).best - summary(late(without), p99).best;
  gates.say("what the publishers cost of it", cost, "ms");
  gates.sayBest("base, without publishers", late(without), share, "% of a core");
  gates.sayBest("base, with all", late(all), share, "% of a core");
  gates.ask("packets lost at the intake, with all", sum(all, "lost"), 0, "");
  gates.ask("pictures lost by consoles, with all", sum(all, "dropped") + sum(all, "posts"), 0, "");
  gates.say("messages to the Foxglove client that reads", sum(all, "read") / kBlocks, "/s");
  gates.ask("losses told to it", sum(all, "losses"), 0, "");
  gates.say("messages lost by the one that is stopped", sum(all, "stopped") / kBlocks, "");
}

await judged("publishers", measure);
