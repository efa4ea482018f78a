/**
 * Beside every page while the car is stopped: what stopped it, since when, who latched it, and the
 * way back to driving as buttons in their order, each with what it still waits for. All of it is
 * the base's; a release names the latch that this card has shown, so that it never undoes another.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../store/session";
import { isHolder, isOperator, send } from "../store/uplink";
import { AgeSince } from "../view/age_since";
import { clockText } from "../view/format";
import { HoldButton } from "../view/hold_button";
import { quantityText, inDisplayUnits } from "../view/display_units";
import type { RecoveryStep, StopState } from "../wire/messages";
import { showPage } from "./pages";

export const kReleaseHoldMs = 600;

const kAsks = {
  release: "RELEASE",
  acknowledge: "ACKNOWLEDGE",
  reset: "RESET",
  arm: "ARM",
} as const;
const kDone = {
  release: "released",
  acknowledge: "acknowledged",
  reset: "reset",
  arm: "armed",
} as const;

function recover(step: RecoveryStep, challenge: number | undefined): void {
  send({ type: "recover", step: step.step, ...(step.step === "release" ? { challenge } : {}) });
}

function StepButton({ step, challenge }: { step: RecoveryStep; challenge?: number }) {
  const words = kAsks[step.step];
  // Who may not command may acknowledge: that concerns the pit wall alone.
  const may = step.step === "acknowledge" ? isOperator.value : isHolder.value;
  const disabled = !step.possible || !may;
  if (step.step !== "release") {
    return (
      <button type="button" disabled={disabled} onClick={() => recover(step, challenge)}>
        {words}
      </button>
    );
  }
  return (
    <HoldButton
      holdMs={kReleaseHoldMs}
      class="release"
      label="release the stop, hold"
      disabled={disabled}
      onHeld={() => recover(step, challenge)}
    >
      {words} <small>hold</small>
    </HoldButton>
  );
}

/** The command of this way that is under way to the car. */
function underWay(step: RecoveryStep): string {
  const name = step.step === "release" ? "release stop" : step.step;
  const newest = session.ladder.value.findLast((ticket) => ticket.name === name);
  return newest && ["sent", "received"].includes(newest.step) ? `${newest.step} \u2026` : "";
}

function Step({ step, challenge }: { step: RecoveryStep; challenge?: number }) {
  const why = step.done ? "" : underWay(step) || inDisplayUnits(step.why);
  const standing = step.done ? "done" : step.possible ? "possible" : "waits";
  return (
    <li data-step={step.step} data-standing={standing}>
      {step.done ? (
        <p class="done">{kDone[step.step]}</p>
      ) : (
        <StepButton step={step} challenge={challenge} />
      )}
      {why && <p class="why">{why}</p>}
    </li>
  );
}

/** Commanding takes the authority: the way to it, where this console has none. */
function Authority() {
  if (!isOperator.value || isHolder.value) return null;
  const held = Boolean(session.authority.value?.holder);
  return (
    <div class="authority-first">
      {held ? (
        <button type="button" onClick={() => showPage("commands")}>
          Ask for the authority
        </button>
      ) : (
        <button type="button" onClick={() => send({ type: "authority", do: "take" })}>
          Take the authority
        </button>
      )}
    </div>
  );
}

function Since({ stop }: { stop: StopState }) {
  if (typeof stop.since_ms !== "number") return <>before this base received the car</>;
  return (
    <>
      {clockText(session.clock.utcMs(stop.since_ms))} UTC, <AgeSince sinceMs={stop.since_ms} /> ago
    </>
  );
}

export function StopCard() {
  const stop = session.stopState.value;
  if (!stop) return null;
  const crossed = quantityText(stop.value, stop.unit);
  const replay = session.hello.value?.mode === "REPLAY";
  const emergency = /EMERGENCY/.test(stop.level ?? "");
  return (
    <aside class="stop-card" aria-label="the stop and the way back" data-emergency={emergency}>
      <div role="alert">
        <h2>
          {stop.level?.toUpperCase()}
          {session.presence.value !== "here" && <small> as last received</small>}
        </h2>
      </div>
      <dl>
        <dt>cause</dt>
        <dd class="cause">{stop.cause || "not known"}</dd>
        {crossed && <dt>value</dt>}
        {crossed && <dd class="crossed">{crossed}</dd>}
        <dt>since</dt>
        <dd class="stopped-since">
          <Since stop={stop} />
        </dd>
        <dt>latched by</dt>
        <dd class="latched-by">{stop.by || "the car itself"}</dd>
        <dt>car</dt>
        <dd class="stopped-mode">{stop.mode}</dd>
      </dl>
      {!replay && (
        <>
          <h3>Back to driving</h3>
          <Authority />
          <ol>
            {(stop.steps ?? []).map((step) => (
              <Step step={step} challenge={stop.challenge} key={step.step} />
            ))}
          </ol>
        </>
      )}
    </aside>
  );
}
