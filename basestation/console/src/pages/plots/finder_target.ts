/**
 * Where a field goes that was found or dropped: into a chart, or into a new one.
 */
// SPDX-License-Identifier: Apache-2.0
import { requestEarlier } from "./backfill";
import { addToChart, plotField } from "./layout";

export const plotTarget = {
  /** The chart whose "+" opened the finder; null is a new chart. */
  chart: null as number | null,

  add(chart: number | null, path: string): void {
    requestEarlier(path);
    if (chart === null) plotField(path);
    else addToChart(chart, path);
    plotTarget.chart = null;
  },
};
