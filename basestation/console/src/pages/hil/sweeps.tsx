/**
 * The sweeps that have ended where the bench server runs: how many cases of each passed, and the
 * page.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import type { BenchSweep } from "../../wire/bench";
import { PageLink } from "./bench_page";

export const hasPassed = (sweep: BenchSweep): boolean => sweep.passed === sweep.cases;

/** The verdicts beside "passed" that some case has. */
export function otherVerdicts(sweep: BenchSweep): string {
  return (["failed", "contact", "refused", "crashed"] as const)
    .filter((verdict) => sweep[verdict] > 0)
    .map((verdict) => `${sweep[verdict]} ${verdict}`)
    .join(", ");
}

function countText(sweep: BenchSweep): string {
  const others = hasPassed(sweep) ? "" : `, ${otherVerdicts(sweep)}`;
  return `${sweep.passed} of ${sweep.cases} cases passed${others}`;
}

export function SweepsPanel() {
  const sweeps = session.shownCar.value.bench.sweeps.value;
  if (sweeps.length === 0) return null;
  return (
    <section class="panel" aria-label="sweeps" tabIndex={0}>
      <h2>Sweeps</h2>
      <ul class="sweeps">
        {sweeps.map((sweep) => (
          <li key={sweep.report}>
            <b data-standing={hasPassed(sweep) ? "holds" : "failed"}>
              {hasPassed(sweep) ? "PASSED" : "FAILED"}
            </b>{" "}
            <PageLink page={sweep.page} file={sweep.report} text={sweep.name} />: {countText(sweep)}
            {!sweep.page && " (no page)"}
          </li>
        ))}
      </ul>
    </section>
  );
}
