/**
 * The bench: its scenarios, the run that goes on, its faults on a time axis, its grades against the
 * gates and its verdict. Everything here is simulation, and says so.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { isOperator, send } from "../../store/uplink";
import type { BenchRun } from "../../wire/bench";
import { kDash, lapText } from "../../view/format";
import { speedUnit } from "../../view/speed_unit";
import { ChooserPanel } from "./chooser";
import { PageLink } from "./bench_page";
import { ContactPanel } from "./contact";
import { ErrorPanel, ExpectationPanel, ReactionPanel } from "./grades";
import { SweepsPanel } from "./sweeps";
import { TimelinePanel } from "./timeline";
import "./hil.css";

const kVerdicts = {
  running: "RUNNING",
  passed: "PASSED",
  failed: "FAILED",
  contact: "CONTACT",
  unusable: "NO VERDICT",
  crashed: "CRASHED",
  stopped: "STOPPED",
} as const;

function Figures() {
  const at = session.shownCar.value.bench.at.value;
  const { name, perMps } = speedUnit.value;
  const figures: [string, string][] = [
    ["time", at ? `${at.t_s.toFixed(1)} s` : kDash],
    [
      "speed",
      typeof at?.speed_mps === "number" ? `${(at.speed_mps * perMps).toFixed(0)} ${name}` : kDash,
    ],
    ["mode", at?.mode || kDash],
    ["flag", at?.flag || kDash],
    ["laps", at ? String(at.laps) : kDash],
    ["best lap", lapText(at?.best_lap_s ?? NaN)],
    ["nearest to a wall", at?.wall_gap_m != null ? `${at.wall_gap_m.toFixed(2)} m` : kDash],
    ["wall hit", at ? (at.contact ? "YES" : "no") : kDash],
  ];
  return (
    <dl class="figures">
      {figures.map(([label, text]) => (
        <div key={label}>
          <dt>{label}</dt>
          <dd>{text}</dd>
        </div>
      ))}
    </dl>
  );
}

function RunPanel({ run }: { run: BenchRun }) {
  const files = [run.junit, run.log].filter((file) => file !== null);
  return (
    <section class="panel run" aria-label="run" tabIndex={0}>
      <h2>
        <output class="verdict" data-state={run.state} aria-label="state of the run">
          {kVerdicts[run.state]}
        </output>
        Run {run.run}: {run.scenario}
        <span class="sum">
          {run.mode}, seed {run.seed}
          {run.by && `, by ${run.by}`}
        </span>
        {run.state === "running" && isOperator.value && (
          <button type="button" onClick={() => send({ type: "bench", do: "stop" })}>
            Stop the simulation
          </button>
        )}
      </h2>
      {run.why && <p class="problem">{run.why}</p>}
      {run.stopped_by && <p class="problem">stopped by {run.stopped_by}</p>}
      <Figures />
      {run.state !== "running" && files.length > 0 && (
        <p class="files">
          {run.page && <PageLink page={run.page} file={run.report} text="Page of the run" />}
          {files.map((file) => (
            <code key={file}>{file}</code>
          ))}
        </p>
      )}
    </section>
  );
}

function Newest() {
  const { run, plan, at, result, events } = session.shownCar.value.bench;
  if (run.value === null) {
    return (
      <section class="panel grows" aria-label="run">
        <h2>Run</h2>
        <p class="empty">Nothing has been run since the server was started.</p>
      </section>
    );
  }
  const contact = result.value?.result?.car_contact;
  return (
    <>
      <RunPanel run={run.value} />
      {contact && <ContactPanel contact={contact} />}
      {plan.value && (
        <TimelinePanel plan={plan.value} nowS={at.value?.t_s ?? 0} events={events.value} />
      )}
      <div class="grades">
        {plan.value && <ExpectationPanel plan={plan.value} at={at.value} />}
        {at.value && <ErrorPanel at={at.value} />}
        <ReactionPanel reactions={result.value?.reactions ?? at.value?.reactions ?? []} />
      </div>
    </>
  );
}

export function HilPage() {
  const link = session.shownCar.value.bench.link.value;
  return (
    <main class="page hil-page" data-up={link?.up ?? false}>
      <p class="simulation" role="note">
        <b>HIL</b> simulation: nothing here comes from a car or goes to one.
        {link === null && " This base was given no bench server (--bench)."}
        {link &&
          !link.up &&
          ` ${link.why_not ?? "no server"}${link.problem ? `: ${link.problem}` : ""}.`}
        {link && link.malformed > 0 && ` ${link.malformed} lines of the server were no lines.`}
      </p>
      <div class="column">
        <ChooserPanel />
      </div>
      <div class="column wide">
        <Newest />
        <SweepsPanel />
      </div>
    </main>
  );
}
