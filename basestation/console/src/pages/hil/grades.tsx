/**
 * How the run does so far: the scenario's expectations, the cross-track error by bracket of speed
 * beside the paper's figures, reactions and stop distances. Graded by the bench, not here.
 */
// SPDX-License-Identifier: Apache-2.0
import type { BenchAt, BenchPlan, Reaction, TrackError } from "../../wire/bench";
import { kDash } from "../../view/format";
import { speedUnit } from "../../view/speed_unit";
import { TableHead } from "../../view/table_head";

const figure = (value: number | null | undefined, decimals: number): string =>
  typeof value === "number" && Number.isFinite(value) ? value.toFixed(decimals) : kDash;

const kBeats = { best: "\u2264 best", mean: "\u2264 mean", neither: "above" } as const;

function ErrorRow({ name, row }: { name: string; row: TrackError }) {
  return (
    <tr data-beats={row.beats ?? "none"}>
      <th scope="row">{name}</th>
      <td>{figure(row.mean_m, 3)}</td>
      <td>{figure(row.max_m, 3)}</td>
      <td>{figure(row.paper_best_m, 3)}</td>
      <td>{figure(row.paper_mean_m, 3)}</td>
      <td>{row.beats ? kBeats[row.beats] : kDash}</td>
    </tr>
  );
}

function bracketName(row: TrackError): string {
  const { perMps } = speedUnit.value;
  const from = Math.round((row.from_mps ?? 0) * perMps);
  return typeof row.to_mps === "number"
    ? `${from}\u2013${Math.round(row.to_mps * perMps)}`
    : `${from} and more`;
}

export function ErrorPanel({ at }: { at: BenchAt }) {
  return (
    <section class="panel" aria-label="cross-track error" tabIndex={0}>
      <h2>
        Cross-track error <span class="sum">m, by {speedUnit.value.name}</span>
      </h2>
      <table class="readings wide">
        <TableHead names={["speed", "mean", "largest", "paper best", "paper mean", "reached"]} />
        <tbody>
          <ErrorRow name="all above 10 m/s" row={at.overall} />
          {at.cross_track.map((row) => (
            <ErrorRow name={bracketName(row)} row={row} key={row.from_mps} />
          ))}
        </tbody>
      </table>
    </section>
  );
}

export function ReactionPanel({ reactions }: { reactions: readonly Reaction[] }) {
  const { name, perMps } = speedUnit.value;
  return (
    <section class="panel" aria-label="reactions" tabIndex={0}>
      <h2>Reactions</h2>
      <table class="readings wide">
        <TableHead names={["to", "at s", `from ${name}`, "reaction ms", "stop distance m"]} />
        <tbody>
          {reactions.map((one, i) => (
            <tr key={i}>
              <th scope="row">{one.to}</th>
              <td>{figure(one.at_s, 2)}</td>
              <td>{figure(one.speed_mps === null ? null : one.speed_mps * perMps, 0)}</td>
              <td>{figure(one.reaction_ms, 0)}</td>
              <td>{figure(one.stop_m, 1)}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {reactions.length === 0 && (
        <p class="empty">No flag or stop has asked the car for more caution yet.</p>
      )}
    </section>
  );
}

const kWords = { open: "OPEN", holds: "HOLDS", failed: "FAILED" } as const;

export function ExpectationPanel({ plan, at }: { plan: BenchPlan; at: BenchAt | null }) {
  return (
    <section class="panel" aria-label="expectations" tabIndex={0}>
      <h2>Expectations</h2>
      <ol class="expectations">
        {plan.expect.map((text, i) => {
          const standing = at?.expect[i] ?? "open";
          return (
            <li data-standing={standing} key={i}>
              <b>{kWords[standing]}</b> {text}
            </li>
          );
        })}
      </ol>
      {plan.expect.length === 0 && <p class="empty">This scenario expects nothing.</p>}
    </section>
  );
}
