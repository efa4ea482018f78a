/**
 * The scenarios of the desk: find one by a few letters, see what it does, start it with a seed.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import * as session from "../../store/session";
import { isOperator, send } from "../../store/uplink";
import type { BenchMode, BenchScenario } from "../../wire/bench";
import { durationText } from "../../view/format";

/** Every word is in the name, the description or a fault. */
export function findScenarios(
  all: readonly BenchScenario[],
  query: string,
): readonly BenchScenario[] {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  const text = (s: BenchScenario) =>
    `${s.id} ${s.name} ${s.description} ${s.faults.join(" ")}`.toLowerCase();
  return all.filter((s) => words.every((word) => text(s).includes(word)));
}

/** A whole number that the bench takes, null for the file's own, undefined for none that is one. */
export function seedOf(text: string): number | null | undefined {
  if (text.trim() === "") return null;
  return /^\d{1,10}$/.test(text.trim()) && Number(text) <= 1e9 ? Number(text) : undefined;
}

function Starter({ scenario }: { scenario: BenchScenario }) {
  const [seed, setSeed] = useState("");
  const [wanted, setMode] = useState<BenchMode>("lockstep");
  const link = session.shownCar.value.bench.link.value;
  const run = session.shownCar.value.bench.run.value;
  const runs = run?.state === "running";
  const modes = (["lockstep", "live"] as const).filter((mode) => scenario[mode]);
  const mode = modes.includes(wanted) ? wanted : modes[0];
  const number = seedOf(seed);
  const barred = !link?.may_start || runs || scenario.problem !== null || number === undefined;
  return (
    <form
      class="entry starter"
      onSubmit={(e) => {
        e.preventDefault();
        if (!barred)
          send({ type: "bench", do: "start", scenario: scenario.id, seed: number, mode });
      }}
    >
      <label>
        seed
        <input
          inputMode="numeric"
          value={seed}
          placeholder={String(scenario.seed)}
          aria-invalid={number === undefined}
          onInput={(e) => setSeed(e.currentTarget.value)}
        />
      </label>
      <label>
        bench
        <select value={mode} onChange={(e) => setMode(e.currentTarget.value as BenchMode)}>
          {modes.map((one) => (
            <option key={one}>{one}</option>
          ))}
        </select>
      </label>
      <button type="submit" disabled={barred}>
        Start in simulation
      </button>
      {runs && <span class="sum">a run goes on</span>}
      {link?.why_not && <span class="sum">{link.why_not}</span>}
    </form>
  );
}

function Details({ scenario }: { scenario: BenchScenario }) {
  return (
    <div class="details">
      <h3>{scenario.id}</h3>
      <p>{scenario.description}</p>
      {scenario.problem && <p class="problem">cannot be started: {scenario.problem}</p>}
      {scenario.faults.length > 0 && <p>Faults: {scenario.faults.join(", ")}</p>}
      <ul class="expected">
        {scenario.expect.map((text) => (
          <li key={text}>{text}</li>
        ))}
      </ul>
      {isOperator.value && <Starter scenario={scenario} key={scenario.id} />}
    </div>
  );
}

export function ChooserPanel() {
  const [query, setQuery] = useState("");
  const [chosen, choose] = useState("");
  const all = session.shownCar.value.bench.scenarios.value;
  const found = findScenarios(all, query);
  const scenario = found.find((one) => one.id === chosen) ?? found[0];
  return (
    <section class="panel grows chooser" aria-label="scenarios" tabIndex={0}>
      <h2>
        Scenarios{" "}
        <span class="sum">
          {found.length} of {all.length}
        </span>
      </h2>
      <input
        class="filter"
        type="search"
        aria-label="filter the scenarios"
        placeholder="filter: name, words, fault"
        value={query}
        onInput={(e) => setQuery(e.currentTarget.value)}
      />
      <ul class="scenarios">
        {found.map((one) => (
          <li key={one.id}>
            <button
              type="button"
              aria-pressed={one === scenario}
              data-problem={one.problem !== null}
              onClick={() => choose(one.id)}
            >
              <span class="id">{one.id}</span>
              <span class="length">{durationText((one.duration_s ?? NaN) * 1000)}</span>
            </button>
          </li>
        ))}
      </ul>
      {all.length === 0 && <p class="empty">No scenario received yet.</p>}
      {scenario && <Details scenario={scenario} />}
    </section>
  );
}
