/**
 * LCM event logs of the recorders, read without our own code: events as lcm/eventlog.c has them,
 * messages of the registry's groups as lcm-gen lays them out.
 */
// SPDX-License-Identifier: Apache-2.0
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

const kSync = 0xeda1da01;
const kEventHead = 28;
/** Fingerprint and time of the sample. */
const kMessageHead = 16;

/** Events of one log: {ms, channel, data}, the time since 1970 in ms; a cut one ends it. */
function* eventsOf(bytes) {
  for (let at = 0; at + kEventHead <= bytes.length;) {
    if (bytes.readUInt32BE(at) !== kSync) throw new Error(`no event at byte ${at}`);
    const ms = Number(bytes.readBigInt64BE(at + 12)) / 1000;
    const name = bytes.readUInt32BE(at + 20);
    const size = bytes.readUInt32BE(at + 24);
    at += kEventHead;
    if (at + name + size > bytes.length) return;
    const channel = bytes.toString("latin1", at, at + name);
    yield { ms, channel, data: bytes.subarray(at + name, at + name + size) };
    at += name + size;
  }
}

/** All events of a recording's folder, log after log. */
export function events(folder) {
  const logs = readdirSync(folder).filter((name) => name.endsWith(".lcm"));
  return logs.sort().flatMap((name) => [...eventsOf(readFileSync(join(folder, name)))]);
}

/** What one field was: [{ms, value}]; `paths` are those of the registry, in its order. */
export function samples(all, paths, path) {
  const [group] = path.split(".");
  const place = paths.filter((one) => one.startsWith(`${group}.`)).indexOf(path);
  if (place < 0) throw new Error(`no field ${path}`);
  const at = kMessageHead + 8 * place;
  return all
    .filter(({ channel }) => channel === `/car/${group}`)
    .map(({ ms, data }) => ({ ms, value: data.readDoubleBE(at) }));
}
