/**
 * Every command's way: staged, gated, sent, received by the car, applied by the car, with the time
 * between the steps, or where it fell.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { inDisplayUnits } from "../../view/display_units";
import type { CommandStep } from "../../wire/messages";
import { argumentText, isFallen, kClimb, rung } from "./steps";

const kShown = 12;

function Rungs({ step }: { step: CommandStep }) {
  const reached = rung(step);
  const times = step.times_ms ?? {};
  const first = Math.min(...Object.values(times));
  return (
    <ol class="rungs">
      {kClimb.map((name, i) => (
        <li key={name} data-reached={i <= reached}>
          {name}
          {times[name] !== undefined && Number.isFinite(first) && (
            <small>+{((times[name] - first) / 1000).toFixed(2)} s</small>
          )}
        </li>
      ))}
      {isFallen(step) && (
        <li class="fallen" data-reached="true">
          {step.step}
        </li>
      )}
    </ol>
  );
}

export function LadderPanel() {
  const steps = session.ladder.value.slice(-kShown).reverse();
  return (
    <section class="panel" aria-label="ladder" tabIndex={0}>
      <h2>Ladder</h2>
      <ul class="ladder" aria-live="polite">
        {steps.map((step) => (
          <li key={step.ticket} data-fallen={isFallen(step)}>
            <span class="name">
              {step.name} <b>{argumentText(step, session.commands.value)}</b>
            </span>
            <span class="by">{step.by}</span>
            <Rungs step={step} />
            {step.text && <span class="text">{inDisplayUnits(step.text)}</span>}
          </li>
        ))}
      </ul>
      {steps.length === 0 && <p class="empty">No command yet.</p>}
    </section>
  );
}
