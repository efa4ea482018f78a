/**
 * The staged command: chosen and filled in, answered by the base with its gates, sent by holding.
 * A gate that is shut can be overridden only with a reason and a second person's token.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import * as session from "../../store/session";
import { isHolder, send } from "../../store/uplink";
import { ageText, kDash } from "../../view/format";
import { HoldButton } from "../../view/hold_button";
import { speedUnit } from "../../view/speed_unit";
import type { CommandInfo, CommandStep, Gate } from "../../wire/messages";
import { argumentText, isPending } from "./steps";

export const kSendHoldMs = 600;

function GateRow({ gate }: { gate: Gate }) {
  const value =
    typeof gate.value === "number"
      ? String(Math.round(gate.value * 100) / 100)
      : (gate.value ?? kDash);
  return (
    <li class="gate" data-ok={gate.ok}>
      <i class="mark" aria-hidden="true" />
      <span class="verdict">{gate.ok ? "pass" : "REFUSES"}</span>
      <span class="name">{gate.name}</span>
      <span class="number">{value}</span>
      <span class="age">{typeof gate.age_ms === "number" ? ageText(gate.age_ms) : ""}</span>
      <span class="text">{gate.text}</span>
    </li>
  );
}

function StagedCard({ step }: { step: CommandStep }) {
  const [reason, setReason] = useState("");
  const [token, setToken] = useState("");
  const gates = step.gates ?? [];
  const shut = gates.filter((gate) => !gate.ok);
  const ready = gates.length > 0 || step.step === "gated";
  const overridden = reason.trim() !== "" && token.trim() !== "";
  const cancel = () => send({ type: "cancel", ticket: step.ticket });
  return (
    <article class="staged" aria-label={`staged ${step.name}`}>
      <h3>
        {step.name} <strong>{argumentText(step, session.commands.value)}</strong>
      </h3>
      <ul class="gates">
        {gates.map((gate) => (
          <GateRow gate={gate} key={gate.name} />
        ))}
      </ul>
      {!ready && <p class="empty">The base looks at the gates.</p>}
      {shut.length > 0 && (
        <fieldset class="override">
          <legend>{shut.length === 1 ? "One gate refuses" : `${shut.length} gates refuse`}</legend>
          <label>
            reason
            <input value={reason} onInput={(e) => setReason(e.currentTarget.value)} />
          </label>
          <label>
            second person's token
            <input
              type="password"
              value={token}
              autocomplete="off"
              onInput={(e) => setToken(e.currentTarget.value)}
            />
          </label>
        </fieldset>
      )}
      <div class="tools">
        <HoldButton
          holdMs={kSendHoldMs}
          class="send"
          label={`send ${step.name}, hold`}
          disabled={!ready || (shut.length > 0 && !overridden)}
          onHeld={() =>
            send({
              type: "send",
              ticket: step.ticket,
              ...(shut.length > 0
                ? { override: { reason: reason.trim(), token: token.trim() } }
                : {}),
            })
          }
        >
          {shut.length > 0 ? "Hold to override and send" : "Hold to send"}
        </HoldButton>
        <button type="button" onClick={cancel}>
          Cancel
        </button>
      </div>
    </article>
  );
}

function Argument({
  info,
  text,
  onText,
}: {
  info: CommandInfo;
  text: string;
  onText: (text: string) => void;
}) {
  const labels = info.labels ?? [];
  if (labels.length > 0 && info.unit !== "bits") {
    return (
      <select aria-label="argument" value={text} onChange={(e) => onText(e.currentTarget.value)}>
        {labels.map((label, i) => (
          <option value={String(i)} key={label}>
            {label}
          </option>
        ))}
      </select>
    );
  }
  const isSpeed = info.unit === "m/s";
  const factor = isSpeed ? speedUnit.value.perMps : 1;
  return (
    <label class="amount">
      <input
        type="number"
        aria-label="argument"
        required
        value={text}
        min={info.min * factor}
        max={Math.floor(info.max * factor)}
        step={isSpeed ? 1 : info.resolution}
        onInput={(e) => onText(e.currentTarget.value)}
      />
      <span class="unit">{isSpeed ? speedUnit.value.name : info.unit}</span>
    </label>
  );
}

export function StagePanel() {
  const infos = session.commands.value;
  const [name, setName] = useState("");
  const [text, setText] = useState("0");
  const info = infos.find((command) => command.name === name) ?? infos[0];
  const pending = session.ladder.value.filter(isPending);
  const barred = !isHolder.value && (info?.needs_authority ?? true);
  const value = Number(text) / (info?.unit === "m/s" ? speedUnit.value.perMps : 1);
  return (
    <section class="panel grows" aria-label="stage a command" tabIndex={0}>
      <h2>Stage a command</h2>
      {info && (
        <form
          class="stage"
          onSubmit={(e) => {
            e.preventDefault();
            send({ type: "stage", name: info.name, argument: value });
          }}
        >
          <select
            aria-label="command"
            value={info.name}
            onChange={(e) => {
              setName(e.currentTarget.value);
              setText("0");
            }}
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
      {pending.map((step) => (
        <StagedCard step={step} key={step.ticket} />
      ))}
    </section>
  );
}
