/**
 * The right edge, on every page: a controlled stop at one press, an emergency stop held for 400 ms.
 * A replay has no such rail, because there is nothing to stop. Where the base has several cars the
 * buttons say which one they stop, the one that is shown, and one more stops all of them.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { isOperator, lastStop, stop, stopAll } from "../store/uplink";
import { CarChip } from "./car_tabs";
import { HoldButton } from "../view/hold_button";
import { kEachFrame, usePainter } from "../view/painting";
import { stopOutcome } from "../view/shown";
import { readLive } from "../view/timeline";

export const kEmergencyHoldMs = 400;

/** What the car itself says about a stop, and what became of the press. */
function Outcome() {
  const root = useRef<HTMLParagraphElement>(null);
  const store = session.fields.value;
  const slot = store.slot("mode.stop_latch");
  usePainter(
    () => {
      if (!root.current) return;
      const reading = readLive(slot);
      const label = store.info[slot]?.labels?.[reading.value];
      const outcome = stopOutcome(reading, label, lastStop.value, performance.now());
      const { text } = outcome;
      if (root.current.textContent !== text) root.current.textContent = text;
      root.current.dataset.failed = String(outcome.failed);
    },
    kEachFrame,
    [store, slot],
  );
  return <p class="outcome" role="alert" ref={root} />;
}

/** Needs no authority, as each stop; possible as long as one base's session can send one. */
function StopAll() {
  const { value: cars } = session.cars;
  return (
    <button
      type="button"
      class="stop controlled all"
      disabled={!cars.some((car) => car.isOperator.value)}
      onClick={stopAll}
    >
      <strong>STOP ALL</strong>
      <span>{cars.length} cars</span>
      <kbd>Ctrl Shift X</kbd>
    </button>
  );
}

export function StopRail() {
  const mode = session.hello.value?.mode;
  if (mode === "REPLAY") {
    return (
      <aside class="stop-rail" aria-label="no stop in a replay">
        <p>no car</p>
      </aside>
    );
  }
  const gone = session.presence.value === "gone";
  const barred = !isOperator.value;
  const { number } = session.shownCar.value;
  const whose = session.hasSeveral.value ? ` ${number}` : "";
  return (
    <aside class="stop-rail" aria-label={whose ? `stop car${whose}` : "stop the car"}>
      {whose && <CarChip car={session.shownCar.value} />}
      <button
        type="button"
        class="stop controlled"
        disabled={barred}
        onClick={() => stop("controlled")}
      >
        <strong>STOP{whose}</strong>
        <span>controlled</span>
        <kbd>Esc Esc</kbd>
      </button>
      <Outcome />
      {barred && (
        <p class="barred">
          {gone || !mode ? "NO BASE: no stop from here" : "viewer: no stop from here"}
        </p>
      )}
      {whose && <StopAll />}
      <HoldButton
        holdMs={kEmergencyHoldMs}
        class="stop emergency"
        disabled={barred}
        label={whose ? `emergency stop of car${whose}, hold` : "emergency stop, hold"}
        onHeld={() => stop("emergency")}
      >
        <strong>E&#8209;STOP{whose}</strong>
        <span>hold</span>
        <kbd>Ctrl Shift E</kbd>
      </HoldButton>
    </aside>
  );
}
