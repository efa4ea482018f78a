/**
 * What the machine did to a test that lives in real time: its host may take a virtual machine's
 * processors away for tens of milliseconds.
 */
// SPDX-License-Identifier: Apache-2.0
import { readFileSync, readdirSync } from "node:fs";
import { cpus, release, type } from "node:os";

const kMsPerTick = 10;
const kStealColumn = 8;
/** Of the first line of /proc/stat: user, nice, system, irq, softirq. */
const kBusyColumns = [1, 2, 3, 6, 7];

const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);
const machineTicks = () =>
  readFileSync("/proc/stat", "utf8").split("\n")[0].split(/ +/).map(Number);

/** Processor time that the host kept from this machine since its start: `steal`, see proc(5). */
export function takenMs() {
  return machineTicks()[kStealColumn] * kMsPerTick;
}

/** The parent of a process, and what it and its ended children have had of processors. */
function processOf(pid) {
  try {
    const text = readFileSync(`/proc/${pid}/stat`, "utf8");
    const fields = text
      .slice(text.lastIndexOf(")") + 2)
      .split(" ")
      .map(Number);
    return { parent: fields[1], ticks: sum(fields.slice(11, 15)) };
  } catch {
    return undefined; // it has just ended
  }
}

/** Processor time that went to others than this process and those that descend from it. */
export function othersMs() {
  const busy = machineTicks();
  const pids = readdirSync("/proc").map(Number).filter(Number.isInteger);
  const processes = new Map(pids.map((pid) => [pid, processOf(pid)]));
  const isOurs = (pid) => pid === process.pid || (pid > 1 && isOurs(processes.get(pid)?.parent));
  const ours = sum(pids.filter(isOurs).map((pid) => processes.get(pid)?.ticks ?? 0));
  return (sum(kBusyColumns.map((column) => busy[column])) - ours) * kMsPerTick;
}

/** "AMD EPYC, 2 cores, Linux 6.18.44": what a figure was taken on. */
export function machineName() {
  const cores = cpus();
  const model = cores[0]?.model ?? "unknown processor";
  const count = `${cores.length} ${cores.length === 1 ? "core" : "cores"}`;
  return `${model}, ${count}, ${type()} ${release()}`;
}
