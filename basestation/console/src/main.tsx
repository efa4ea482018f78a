/**
 * Starts the console: style sheet, first frame, keys, the connection to the base, layouts.
 */
// SPDX-License-Identifier: Apache-2.0
import { effect } from "@preact/signals";
import { render } from "preact";
import "./theme/fonts.css";
import "./theme/palette.css";
import "./theme/frame.css";
import "./theme/top_bar.css";
import "./theme/stops.css";
import "./theme/stop_card.css";
import "./theme/silence_band.css";
import "./theme/login.css";
import "./theme/car_tabs.css";
import "./theme/foot.css";
import "./theme/values.css";
import "./theme/primary.css";
import "./theme/pages.css";
import "./theme/tables.css";
import "./theme/alarms.css";
import "./theme/narrow.css";
import { App } from "./app";
import { listenToKeys, selectedAlarm } from "./frame/keys";
import { fetchLaterPages } from "./frame/later";
import { shelving } from "./frame/shelve";
import { listenToAlarms, sounded } from "./frame/tones";
import { forgetEarlier } from "./pages/plots/backfill";
import { plotLayout, readPlotLayout } from "./pages/plots/layout";
import { primaryLayout, readPrimaryLayout } from "./pages/primary/layout";
import type { CarSession } from "./store/car_session";
import { lookForCars, openCars, placeOf } from "./store/cars";
import { fetchLayout } from "./store/layouts";
import { lookForVisitor } from "./store/login";
import { watchPresence } from "./store/presence";
import * as session from "./store/session";
import { keepAuthority } from "./store/uplink";
import { setTheme, theme } from "./theme/theme";
import { repaint, startPainting } from "./view/painting";
import { heldMs, speed } from "./view/timeline";
import type { Track } from "./wire/messages";

const kAskAgainMs = 2000;

async function fetchTrack(car: CarSession): Promise<void> {
  try {
    const answer = await fetch(placeOf("api/track", car));
    car.track.value = answer.status === 200 ? ((await answer.json()) as Track) : null;
  } catch {
    car.track.value = null;
  }
}

async function fetchLayouts(): Promise<void> {
  const [primary, plots] = await Promise.all([
    fetchLayout("primary", readPrimaryLayout),
    fetchLayout("plots", readPlotLayout),
  ]);
  if (primary) primaryLayout.value = primary;
  if (plots) plotLayout.value = plots;
}

setTheme(theme.value);
openCars(); // what they say is on its way while the first frame is drawn
listenToKeys();
render(<App />, document.getElementById("console")!);
startPainting();
keepAuthority();
watchPresence(() => session.cars.value);
listenToAlarms();
void fetchLayouts();
// A refused WebSocket does not say why it was refused.
void lookForVisitor();
setInterval(() => session.connected.value || void lookForVisitor(), kAskAgainMs);

// A base that was started anew may know other cars, and has forgotten our questions; another car
// has another past.
effect(() => {
  if (!session.connected.value) return;
  forgetEarlier();
  void lookForCars();
  void fetchLaterPages();
});
// The map has all cars of the base that are on its track.
effect(() => {
  for (const car of session.cars.value) if (car.connected.value) void fetchTrack(car);
});
// What was chosen among one car's alarms is nothing of another's.
effect(() => {
  if (!session.shownCar.value) return;
  shelving.value = null;
  selectedAlarm.value = null;
});
// A jump in time is seen at once, not at the next turn of each painter.
effect(() => {
  if (heldMs.value === null || speed.value === 0) repaint();
});
// The console as a test or a curious engineer may look into it.
Object.assign(window, { pitwall: { session, sounded } });
