/**
 * The dialog that puts an alarm on the shelf, for a time and a reason: both go into its history.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import * as session from "../store/session";
import { send } from "../store/uplink";

const kMostMinutes = 10;

/** The alarm that the dialog is about; none: it is not shown. */
export const shelving = signal<number | null>(null);

const close = () => (shelving.value = null);

export function ShelveDialog() {
  const field = useRef<HTMLInputElement>(null);
  const [reason, setReason] = useState("");
  const [minutes, setMinutes] = useState(5);
  useLayoutEffect(() => {
    const before = document.activeElement as HTMLElement | null;
    field.current?.focus();
    return () => before?.focus?.();
  }, []);
  const alarm = session.alarms.value?.active.find((a) => a.id === shelving.value);
  if (!alarm) return null;
  return (
    <div class="veil" onClick={close}>
      <div
        class="dialog"
        role="dialog"
        aria-modal="true"
        aria-label="shelve an alarm"
        onClick={(e) => e.stopPropagation()}
      >
        <form
          onSubmit={(e) => {
            e.preventDefault();
            send({ type: "shelve", alarm: alarm.id, minutes, reason: reason.trim() });
            close();
          }}
        >
          <h2>Shelve: {alarm.text}</h2>
          <div class="entry">
            <label>
              reason
              <input
                ref={field}
                required
                pattern=".*\S.*"
                value={reason}
                onInput={(e) => setReason(e.currentTarget.value)}
              />
            </label>
            <label>
              minutes
              <input
                type="number"
                required
                min={1}
                max={kMostMinutes}
                value={minutes}
                onInput={(e) => setMinutes(Number(e.currentTarget.value))}
              />
            </label>
            <button type="submit">Shelve</button>
            <button type="button" onClick={close}>
              Cancel
            </button>
          </div>
        </form>
      </div>
    </div>
  );
}
