/**
 * What this console knows of the bench desk: its scenarios and its newest run. The base tells all
 * of it anew to a console that connects; events of another desk or another run are not kept.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import type * as Wire from "../wire/bench";

export const kKeptEvents = 500;

export class Bench {
  /** Null: this base was given no desk. */
  readonly link = signal<Wire.BenchLink | null>(null);
  readonly scenarios = signal<readonly Wire.BenchScenario[]>([]);
  readonly run = signal<Wire.BenchRun | null>(null);
  readonly plan = signal<Wire.BenchPlan | null>(null);
  readonly at = signal<Wire.BenchAt | null>(null);
  readonly result = signal<Wire.BenchResult | null>(null);
  readonly events = signal<readonly Wire.BenchEvent[]>([]);
  private desk = "";
  /** Of the newest desk; events may come before their run is told. */
  private newest = 0;

  readonly texts = {
    bench: (m: Wire.BenchLink) => (this.link.value = m),
    bench_list: (m: Wire.OfDesk<Wire.BenchScenario[]>) => (this.scenarios.value = m.of),
    bench_run: (m: Wire.OfDesk<Wire.BenchRun>) => {
      this.ofRun(m.desk, m.of.run);
      this.run.value = m.of;
    },
    bench_plan: (m: Wire.OfDesk<Wire.BenchPlan | null>) => (this.plan.value = m.of),
    bench_at: (m: Wire.OfDesk<Wire.BenchAt | null>) => (this.at.value = m.of),
    bench_result: (m: Wire.OfDesk<Wire.BenchResult | null>) => (this.result.value = m.of),
    bench_event: (m: Wire.OfDesk<Wire.BenchEvent>) => {
      this.ofRun(m.desk, m.of.run);
      if (m.of.run !== this.newest) return;
      this.events.value = [...this.events.value, m.of].slice(-kKeptEvents);
    },
  };

  private ofRun(desk: string, run: number): void {
    if (desk === this.desk && run <= this.newest) return;
    this.desk = desk;
    this.newest = run;
    this.events.value = [];
  }
}
