/**
 * What the pit wall knows and the car does not: the round speed that race control announced, and
 * the fuel that was filled in.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import * as session from "../../store/session";
import { isHolder, send } from "../../store/uplink";
import { clockText, fixed, kDash } from "../../view/format";
import { NumberEntry } from "../../view/entry";
import { speedUnit } from "../../view/speed_unit";

const kMostLitres = 200;
const kMostMps = 120;

export function ExpectedPanel() {
  const expected = session.expected.value;
  const [speed, setSpeed] = useState("");
  const [litres, setLitres] = useState("");
  const { perMps, name } = speedUnit.value;
  const round = expected?.round_speed_mps;
  const fuel = expected?.fuel_loaded_l;
  const fuelAt = clockText(session.clock.utcMs(expected?.fuel_ms ?? NaN));
  return (
    <section class="panel" aria-label="what we know" tabIndex={0}>
      <h2>What we know</h2>
      <p class="who">
        Round speed announced:{" "}
        <b>
          {typeof round === "number"
            ? `${fixed(round * perMps, 0)} ${name} (${expected?.round_speed_by})`
            : kDash}
        </b>
        <br />
        Fuel filled in:{" "}
        <b>
          {typeof fuel === "number"
            ? `${fixed(fuel, 1)} l at ${fuelAt} (${expected?.fuel_by})`
            : kDash}
        </b>
      </p>
      {isHolder.value && (
        <div class="expected-entries">
          <form
            class="entry"
            onSubmit={(e) => {
              e.preventDefault();
              send({ type: "expect", round_speed: speed === "" ? null : Number(speed) / perMps });
            }}
          >
            <NumberEntry
              label="round speed"
              unit={name}
              text={speed}
              onText={setSpeed}
              min={0}
              max={Math.floor(kMostMps * perMps)}
            />
            <button type="submit">{speed === "" ? "Take back" : "Announced"}</button>
          </form>
          <form
            class="entry"
            onSubmit={(e) => {
              e.preventDefault();
              send({ type: "fuel_loaded", litres: Number(litres) });
            }}
          >
            <NumberEntry
              label="fuel in the tank"
              unit="l"
              text={litres}
              onText={setLitres}
              min={0}
              max={kMostLitres}
              required
            />
            <button type="submit">In the tank</button>
          </form>
        </div>
      )}
    </section>
  );
}
