/**
 * Which charts the plots page has, as JSON that the base keeps; the presets are such layouts too.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { storeLayout } from "../../store/layouts";

export interface ChartSpec {
  title: string;
  fields: string[];
}

/** Time before the moment shown, or metres along the lap with the newest laps over each other. */
export type PlotAxis = "time" | "distance";

/** Or two laps against each other, with charts of its own. */
export type PlotView = PlotAxis | "laps";

export interface PlotLayout {
  version: 1;
  window_s: number;
  /** Not there: time. */
  axis?: PlotView;
  charts: ChartSpec[];
}

export const kMostCharts = 24;
export const kMostFields = 6;
export const kMostLaps = 3;
export const kWindowsS = [10, 30, 60, 120, 300, 600] as const;

/** How many laps of each field a chart shows beside each other: as many as colours can tell. */
export const lapsBeside = (fields: number): number =>
  Math.max(1, Math.min(kMostLaps, Math.floor(kMostFields / Math.max(fields, 1))));

const wheels = (group: string, what: string): string[] =>
  ["front_left", "front_right", "rear_left", "rear_right"].map((w) => `${group}.${what}${w}`);

const preset = (charts: ChartSpec[]): PlotLayout => ({ version: 1, window_s: 60, charts });

export const kPresets: Record<string, PlotLayout> = {
  controller: preset([
    { title: "speed", fields: ["ego.vx", "track.target_speed"] },
    { title: "cross-track error", fields: ["dynamics.lateral_error"] },
    { title: "steering", fields: ["command.steering", "feedback.steering"] },
    { title: "throttle", fields: ["command.throttle", "feedback.throttle"] },
    { title: "brake", fields: ["command.brake", "feedback.brake_front", "feedback.brake_rear"] },
    { title: "acceleration", fields: ["dynamics.forward", "dynamics.left"] },
  ]),
  tyres: preset([
    { title: "temperature", fields: [...wheels("tyres", "temperature_"), "derived.tyre_gate"] },
    { title: "pressure", fields: wheels("tyres", "pressure_") },
    { title: "tread inner", fields: wheels("tread", "inner_") },
    { title: "tread outer", fields: wheels("tread", "outer_") },
    { title: "wheel speed", fields: [...wheels("wheels", ""), "ego.vx"] },
    { title: "slip", fields: ["derived.slip_rear_front", "derived.slip_rear_gnss"] },
  ]),
  gnss: preset([
    { title: "\u03c3 position", fields: ["gnss0.sigma", "gnss1.sigma"] },
    { title: "satellites", fields: ["gnss0.satellites", "gnss1.satellites"] },
    { title: "correction age", fields: ["gnss0.differential_age", "gnss1.differential_age"] },
    { title: "rate", fields: ["sensors.gnss0_rate", "sensors.gnss1_rate"] },
    { title: "longest gap", fields: ["sensors.gnss0_gap", "sensors.gnss1_gap"] },
    { title: "latency", fields: ["sensors.gnss0_latency", "sensors.gnss1_latency"] },
  ]),
  link: preset([
    { title: "loss", fields: ["link.down_loss", "link.up_loss"] },
    { title: "round trip", fields: ["link.rtt_ms", "link.jitter_ms"] },
    { title: "load", fields: ["link.down_kbit_s", "link.down_cap_kbit_s", "link.up_kbit_s"] },
    { title: "worst age", fields: ["link.worst_age_ms"] },
  ]),
  powertrain: preset([
    { title: "engine speed", fields: ["engine.speed"] },
    {
      title: "temperatures",
      fields: ["engine.coolant", "powertrain.oil", "powertrain.transmission"],
    },
    { title: "pressures", fields: ["engine.oil_pressure", "engine.fuel_pressure"] },
    { title: "torque", fields: ["powertrain.torque"] },
    { title: "battery", fields: ["electric.battery"] },
    { title: "fuel", fields: ["fuel.level", "fuel.flow"] },
  ]),
  localisation: preset([
    { title: "\u03c3 position", fields: ["localization.sigma_x", "localization.sigma_y"] },
    { title: "\u03c3 yaw", fields: ["localization.sigma_yaw"] },
    { title: "\u03c3 speed", fields: ["localization.sigma_vx", "localization.sigma_vy"] },
    { title: "position age", fields: ["localization.position_age"] },
    { title: "outliers", fields: ["localization.outliers", "localization.late"] },
    { title: "height", fields: ["localization.height"] },
  ]),
};

export const plotLayout = signal<PlotLayout>(kPresets.controller);

/** A layout out of untrusted JSON; null where it is none. */
export function readPlotLayout(json: unknown): PlotLayout | null {
  const from = json as Partial<PlotLayout> | null;
  if (!Array.isArray(from?.charts) || typeof from.window_s !== "number") return null;
  if (!(from.window_s >= 1 && from.window_s <= 600)) return null;
  const axis = from.axis ?? "time";
  if (axis !== "time" && axis !== "distance" && axis !== "laps") return null;
  const charts: ChartSpec[] = [];
  for (const chart of from.charts.slice(0, kMostCharts)) {
    if (typeof chart?.title !== "string" || !Array.isArray(chart.fields)) return null;
    const fields = chart.fields.filter((f): f is string => typeof f === "string");
    charts.push({ title: chart.title, fields: fields.slice(0, kMostFields) });
  }
  return { version: 1, window_s: from.window_s, axis, charts };
}

export function changeLayout(to: PlotLayout): void {
  plotLayout.value = to;
  void storeLayout("plots", to);
}

/** A chart of this field alone in front of the others, unless one has it already. */
export function plotField(path: string): void {
  const layout = plotLayout.value;
  if (layout.charts.some((chart) => chart.fields.includes(path))) return;
  const charts = [{ title: path, fields: [path] }, ...layout.charts].slice(0, kMostCharts);
  changeLayout({ ...layout, charts });
}

/** The field beside the others of a chart. */
export function addToChart(index: number, path: string): void {
  const layout = plotLayout.value;
  const charts = layout.charts.map((chart, i) =>
    i === index && !chart.fields.includes(path) && chart.fields.length < kMostFields
      ? { ...chart, fields: [...chart.fields, path] }
      : chart,
  );
  changeLayout({ ...layout, charts });
}

export function removeChart(index: number): void {
  const layout = plotLayout.value;
  changeLayout({ ...layout, charts: layout.charts.filter((_, i) => i !== index) });
}
