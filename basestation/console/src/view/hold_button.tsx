/**
 * A button that acts only after it was held: by pointer, Enter or Space alike. Letting go, leaving
 * it or losing focus before the time is over does nothing.
 */
// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

export interface HoldButtonProps {
  holdMs: number;
  onHeld: () => void;
  class?: string;
  label: string;
  disabled?: boolean;
  children: ComponentChildren;
}

export function HoldButton(props: HoldButtonProps) {
  const [held, setHeld] = useState(false);
  const timer = useRef<number | undefined>(undefined);

  const release = () => {
    clearTimeout(timer.current);
    timer.current = undefined;
    setHeld(false);
  };
  const press = () => {
    if (props.disabled || timer.current !== undefined) return;
    setHeld(true);
    timer.current = window.setTimeout(() => {
      release();
      props.onHeld();
    }, props.holdMs);
  };
  useEffect(() => release, []);

  const isKey = (event: KeyboardEvent) => event.key === "Enter" || event.key === " ";
  return (
    <button
      type="button"
      class={`hold hold-${props.holdMs} ${props.class ?? ""}`}
      data-held={held}
      title={props.label}
      disabled={props.disabled}
      onPointerDown={(e) => {
        if (e.button === 0) press();
      }}
      onPointerUp={release}
      onPointerLeave={release}
      onPointerCancel={release}
      onBlur={release}
      onContextMenu={(e) => e.preventDefault()}
      onKeyDown={(e) => {
        if (!isKey(e)) return;
        e.preventDefault();
        if (!e.repeat) press();
      }}
      onKeyUp={(e) => {
        if (isKey(e)) release();
      }}
    >
      <i class="progress" aria-hidden="true" />
      <span class="face">{props.children}</span>
    </button>
  );
}
