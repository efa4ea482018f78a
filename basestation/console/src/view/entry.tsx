/**
 * What the holder of the authority enters: a number with its unit, and a change that is reviewed
 * with its reason before a button is held.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import type { ComponentChildren } from "preact";
import { HoldButton } from "./hold_button";

export interface NumberEntryProps {
  label: string;
  unit: string;
  text: string;
  onText: (text: string) => void;
  min?: number;
  max?: number;
  required?: boolean;
}

export function NumberEntry({ label, unit, text, onText, ...rest }: NumberEntryProps) {
  return (
    <label class="amount">
      {label}
      <input
        type="number"
        step="any"
        value={text}
        onInput={(e) => onText(e.currentTarget.value)}
        {...rest}
      />
      <span class="unit">{unit}</span>
    </label>
  );
}

export const kApplyHoldMs = 600;

/** Says what will change, asks why, and is applied by holding. */
export function Review(props: {
  changes: readonly string[];
  onApply: (reason: string) => void;
  children?: ComponentChildren;
}) {
  const [reason, setReason] = useState("");
  if (props.changes.length === 0) return <p class="empty">Nothing is changed yet.</p>;
  return (
    <div class="entry review">
      <ul>
        {props.changes.map((change) => (
          <li key={change}>{change}</li>
        ))}
      </ul>
      <label>
        reason
        <input value={reason} onInput={(e) => setReason(e.currentTarget.value)} />
      </label>
      <HoldButton
        holdMs={kApplyHoldMs}
        class="send"
        label="apply the change, hold"
        disabled={reason.trim() === ""}
        onHeld={() => {
          props.onApply(reason.trim());
          setReason("");
        }}
      >
        Hold to apply
      </HoldButton>
    </div>
  );
}
