/**
 * The staged command: chosen and filled in, answered by the base with its gates, sent by holding.
 * A gate that refuses is overridden with a reason, and with a second person's token where this base
 * has tokens; some are never overridden.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import * as session from "../../store/session";
import { isHolder, send } from "../../store/uplink";
import { ageText } from "../../view/format";
import { HoldButton } from "../../view/hold_button";
import { speedUnit } from "../../view/speed_unit";
import { quantityText, inDisplayUnits } from "../../view/display_units";
import type { CommandInfo, CommandStep, Gate } from "../../wire/messages";
import { Argument, isSet } from "./argument";
import { argumentText, isPending } from "./steps";

export const kSendHoldMs = 600;
/** Released on the card of the stop, which knows what the car asks for. */
const kElsewhere = "release stop";

/** What the gate was judged by: its name, or the number in this page's units. */
export function gateValueText(gate: Gate): string {
  return gate.word || quantityText(gate.value, gate.unit) || "no data";
}

function GateRow({ gate }: { gate: Gate }) {
  return (
    <li class="gate" data-ok={gate.ok}>
      <i class="mark" aria-hidden="true" />
      <span class="verdict">{gate.ok ? "pass" : "REFUSES"}</span>
      <span class="name">{gate.name}</span>
      <span class="number">{gateValueText(gate)}</span>
      <span class="age">{typeof gate.age_ms === "number" ? ageText(gate.age_ms) : ""}</span>
      <span class="text">{inDisplayUnits(gate.text)}</span>
    </li>
  );
}

interface Overriding {
  reason: string;
  token: string;
}

/** Why an override does not do yet; empty: it does. */
export function overrideWants(shut: readonly Gate[], by: Overriding, second: boolean): string {
  const never = shut.filter((gate) => gate.can_be_overridden === false);
  if (never.length > 0) {
    return `never overridden: ${never.map((gate) => gate.name).join(", ")}`;
  }
  if (by.reason.trim() === "") return "an override takes a reason";
  if (second && by.token.trim() === "") return "an override takes a second person's token";
  return "";
}

function OverrideFields(props: {
  refusing: number;
  by: Overriding;
  second: boolean;
  onBy: (by: Overriding) => void;
}) {
  const { refusing, by, second, onBy } = props;
  return (
    <fieldset class="override">
      <legend>{refusing === 1 ? "One gate refuses" : `${refusing} gates refuse`}</legend>
      <label>
        reason
        <input value={by.reason} onInput={(e) => onBy({ ...by, reason: e.currentTarget.value })} />
      </label>
      {second && (
        <label>
          second person's token
          <input
            type="password"
            value={by.token}
            autocomplete="off"
            onInput={(e) => onBy({ ...by, token: e.currentTarget.value })}
          />
        </label>
      )}
    </fieldset>
  );
}

function StagedCard({ step }: { step: CommandStep }) {
  const [by, setBy] = useState<Overriding>({ reason: "", token: "" });
  const second = session.hello.value?.second_person ?? true;
  const gates = step.gates ?? [];
  const shut = gates.filter((gate) => !gate.ok);
  const ready = gates.length > 0 || step.step === "gated";
  const wants = shut.length > 0 ? overrideWants(shut, by, second) : "";
  const never = shut.some((gate) => gate.can_be_overridden === false);
  const overriding = {
    reason: by.reason.trim(),
    ...(second ? { token: by.token.trim() } : {}),
  };
  return (
    <article class="staged" aria-label={`staged ${step.name}`}>
      <h3>
        {step.name} <strong>{argumentText(step, session.commands.value)}</strong>
      </h3>
      {!ready && <p class="empty">The base looks at the gates.</p>}
      <ul class="gates">
        {[...shut, ...gates.filter((gate) => gate.ok)].map((gate) => (
          <GateRow gate={gate} key={gate.name} />
        ))}
      </ul>
      <div class="decision">
        {shut.length > 0 && !never && (
          <OverrideFields refusing={shut.length} by={by} second={second} onBy={setBy} />
        )}
        <div class="tools">
          <HoldButton
            holdMs={kSendHoldMs}
            class="send"
            label={`send ${step.name}, hold`}
            disabled={!isHolder.value || !ready || wants !== ""}
            onHeld={() =>
              send({
                type: "send",
                ticket: step.ticket,
                ...(shut.length > 0 ? { override: overriding } : {}),
              })
            }
          >
            {shut.length > 0 && !never ? "Hold to override and send" : "Hold to send"}
          </HoldButton>
          <button type="button" onClick={() => send({ type: "cancel", ticket: step.ticket })}>
            Cancel
          </button>
          {wants && <span class="wants">{wants}</span>}
        </div>
      </div>
    </article>
  );
}

/** Nothing is chosen beforehand: a set begins empty, everything else undecided. */
const undecided = (info: CommandInfo): string => (isSet(info) ? "0" : "");

export function StagePanel() {
  const infos = session.commands.value.filter(
    (command) => command.offered !== false && command.name !== kElsewhere,
  );
  const [name, setName] = useState("");
  const [text, setText] = useState("");
  const info = infos.find((command) => command.name === name) ?? infos[0];
  const pending = session.ladder.value.filter(isPending);
  const barred = !isHolder.value && (info?.needs_authority ?? true);
  const value = Number(text) / (info?.unit === "m/s" ? speedUnit.value.perMps : 1);
  const choose = (chosen: string) => {
    setName(chosen);
    const next = infos.find((command) => command.name === chosen);
    setText(next ? undecided(next) : "");
  };
  return (
    <section class="panel grows stage-panel" aria-label="stage a command" tabIndex={0}>
      <h2>Stage a command</h2>
      {pending.map((step) => (
        <StagedCard step={step} key={step.ticket} />
      ))}
      {info && (
        <form
          class="stage"
          onSubmit={(e) => {
            e.preventDefault();
            if (text === "") return;
            send({ type: "stage", name: info.name, argument: value });
            setText(undecided(info));
          }}
        >
          <select
            aria-label="command"
            value={info.name}
            onChange={(e) => choose(e.currentTarget.value)}
          >
            {infos.map((command) => (
              <option value={command.name} key={command.name}>
                {command.name}
              </option>
            ))}
          </select>
          <Argument info={info} text={text} onText={setText} />
          <button type="submit" disabled={barred || !Number.isFinite(value) || text === ""}>
            Stage
          </button>
        </form>
      )}
      {barred && <p class="empty">Take the authority to stage this command.</p>}
    </section>
  );
}
