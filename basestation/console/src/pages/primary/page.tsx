/**
 * The primary page: the whole car at a glance, nothing scrolls. Grey while all is normal. A panel
 * that has the focus is moved with Alt and the arrows; the layout is kept by the base.
 */
// SPDX-License-Identifier: Apache-2.0
import type { FunctionComponent } from "preact";
import { storeLayout } from "../../store/layouts";
import { MapPanel } from "../../map/panel";
import { ComputerPanel, PowertrainPanel } from "./car_panels";
import { FuelPanel } from "./fuel_panel";
import { GnssPanel } from "./gnss_panel";
import { moved, primaryLayout } from "./layout";
import type { PanelName } from "./layout";
import { SensorPanel } from "./sensor_panel";
import { SpeedPanel } from "./speed_panel";
import { TyrePanel } from "./tyre_panel";
import { WatchdogPanel } from "./watchdog_panel";

const kBodies: Record<PanelName, readonly [string, FunctionComponent]> = {
  map: ["Track", MapPanel],
  speed: ["Speed and control", SpeedPanel],
  tyres: ["Tyres", TyrePanel],
  fuel: ["Fuel", FuelPanel],
  watchdogs: ["Watchdogs", WatchdogPanel],
  sensors: ["Sensors", SensorPanel],
  gnss: ["GNSS", GnssPanel],
  computer: ["Computer", ComputerPanel],
  powertrain: ["Powertrain", PowertrainPanel],
};

function move(event: KeyboardEvent, name: PanelName): void {
  if (!event.altKey || !event.key.startsWith("Arrow")) return;
  event.preventDefault();
  const next = moved(primaryLayout.value, name, event.key);
  if (next === primaryLayout.value) return;
  primaryLayout.value = next;
  void storeLayout("primary", next);
}

function Panel({ name }: { name: PanelName }) {
  const [title, Body] = kBodies[name];
  return (
    <section
      class={`panel panel-${name}`}
      tabIndex={0}
      aria-label={title}
      onKeyDown={(event) => move(event, name)}
    >
      <h2>{title}</h2>
      <Body />
    </section>
  );
}

export function PrimaryPage() {
  const { columns } = primaryLayout.value;
  return (
    <main
      class="page primary"
      style={{ gridTemplateColumns: columns.map((c) => `minmax(0, ${c.share}fr)`).join(" ") }}
    >
      {columns.map((column, i) => (
        <div class="column" key={i}>
          {column.panels.map((name) => (
            <Panel name={name} key={name} />
          ))}
        </div>
      ))}
    </main>
  );
}
