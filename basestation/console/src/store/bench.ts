/**
 * What this console knows of the bench server: its scenarios, its sweeps and its newest run. The
 * base tells all of it anew to a console that connects; events of another server or another run are
 * not kept.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import type * as Wire from "../wire/bench";

export const kKeptEvents = 500;

export class Bench {
  /** Null: this base was given no server. */
  readonly link = signal<Wire.BenchLink | null>(null);
  readonly scenarios = signal<readonly Wire.BenchScenario[]>([]);
  readonly sweeps = signal<readonly Wire.BenchSweep[]>([]);
  readonly run = signal<Wire.BenchRun | null>(null);
  readonly plan = signal<Wire.BenchPlan | null>(null);
  readonly at = signal<Wire.BenchAt | null>(null);
  readonly result = signal<Wire.BenchResult | null>(null);
  readonly events = signal<readonly Wire.BenchEvent[]>([]);
  private server = "";
  /** Of the newest server; events may come before their run is told. */
  private newest = 0;

  readonly texts = {
    bench: (m: Wire.BenchLink) => (this.link.value = m),
    bench_list: (m: Wire.OfServer<Wire.BenchScenario[]>) => (this.scenarios.value = m.of),
    bench_sweeps: (m: Wire.OfServer<{ sweeps: Wire.BenchSweep[] }>) =>
      (this.sweeps.value = m.of.sweeps),
    bench_run: (m: Wire.OfServer<Wire.BenchRun>) => {
      this.ofRun(m.server, m.of.run);
      this.run.value = m.of;
    },
    bench_plan: (m: Wire.OfServer<Wire.BenchPlan | null>) => (this.plan.value = m.of),
    bench_at: (m: Wire.OfServer<Wire.BenchAt | null>) => (this.at.value = m.of),
    bench_result: (m: Wire.OfServer<Wire.BenchResult | null>) => (this.result.value = m.of),
    bench_event: (m: Wire.OfServer<Wire.BenchEvent>) => {
      this.ofRun(m.server, m.of.run);
      if (m.of.run !== this.newest) return;
      this.events.value = [...this.events.value, m.of].slice(-kKeptEvents);
    },
  };

  private ofRun(server: string, run: number): void {
    if (server === this.server && run <= this.newest) return;
    this.server = server;
    this.newest = run;
    this.events.value = [];
  }
}
