/**
 * The table of `long attack`: two lines for each phase, of the attacked pair and of its twin.
 */
// SPDX-License-Identifier: Apache-2.0

const kColumns = [
  { head: "down/s", of: (f) => f.down_per_s },
  { head: "gap", of: (f) => f.down_gap_ms },
  { head: "up/s", of: (f) => f.up_per_s },
  { head: "gap", of: (f) => f.up_gap_ms },
  { head: "stop p50", of: (f) => f.stop_p50_ms },
  { head: "p99", of: (f) => f.stop_p99_ms },
  { head: "presses", of: (f) => f.stops },
  { head: "base %", of: (f) => f.base_percent, digits: 1 },
  { head: "car %", of: (f) => f.car_percent, digits: 1 },
  { head: "base MB", of: (f) => f.base_mb, digits: 1 },
  { head: "car MB", of: (f) => f.car_mb, digits: 1 },
  { head: "refused/s", of: (f) => f.refused_by_base_per_s },
  { head: "by car", of: (f) => f.refused_by_car_per_s },
];
const kNameWidth = 42;
const kAttackWidth = 9;
const width = ({ head }) => Math.max(head.length, 6) + 1;

export const head = () =>
  "packets/s that base (down) and car (up) took, gaps and stops in ms, share of a core\n" +
  "phase".padEnd(kNameWidth) +
  "attack/s".padStart(kAttackWidth) +
  kColumns.map((column) => column.head.padStart(width(column))).join("") +
  "  operator was told (s after the beginning)";

const seconds = (ms) => (ms / 1000).toFixed(1);

/** Alarms with their times, and how many events; the texts of these stand in the JSON file. */
function told(record, i) {
  const alarms = [...record.told[i]].map(([key, ms]) => `${key} ${seconds(ms)}`);
  const events = record.events[i].length;
  return [...alarms, ...(events > 0 ? [`${events} events`] : [])].join(", ") || "-";
}

function notes(record) {
  const { healed, stood, passedOver, linked } = record;
  const links = linked.map(([mine, its]) => `link after ${seconds(mine)} s (twin ${seconds(its)})`);
  if (passedOver > 0) links.push(`${passedOver} presses passed over, the host being busy`);
  if (stood) links.push("its alarm stood before");
  if (healed.length > 0) links.push(`started anew before, no link: ${healed.join(", ")}`);
  return links.map((link) => `    ${link}`);
}

export function lines(record) {
  const { phase, traffic, attackMs } = record;
  const rate = traffic ? ((traffic.sent / attackMs) * 1000).toFixed(0) : "";
  const line = (name, attack, i) =>
    name.padEnd(kNameWidth) +
    attack.padStart(kAttackWidth) +
    kColumns
      .map((column) => column.of(record.figures[i]).toFixed(column.digits ?? 0))
      .map((text, n) => text.padStart(width(kColumns[n])))
      .join("") +
    `  ${told(record, i)}`;
  return [line(phase.name, rate, 0), line("", "", 1), ...notes(record)];
}
