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
import "./theme/foot.css";
import "./theme/values.css";
import "./theme/primary.css";
import "./theme/pages.css";
import "./theme/tables.css";
import "./theme/alarms.css";
import "./theme/narrow.css";
import { App } from "./app";
import { listenToKeys } from "./frame/keys";
import { fetchLaterPages } from "./frame/later";
import { listenToAlarms, sounded } from "./frame/tones";
import { forgetEarlier } from "./pages/plots/backfill";
import { plotLayout, readPlotLayout } from "./pages/plots/layout";
import { primaryLayout, readPrimaryLayout } from "./pages/primary/layout";
import { fetchLayout, token } from "./store/layouts";
import * as session from "./store/session";
import { keepAuthority, openUplink } from "./store/uplink";
import { setTheme, theme } from "./theme/theme";
import { repaint, startPainting } from "./view/painting";
import { heldMs, speed } from "./view/timeline";
import type { Track } from "./wire/messages";

async function fetchTrack(): Promise<void> {
  try {
    const answer = await fetch("api/track");
    session.track.value = answer.status === 200 ? ((await answer.json()) as Track) : null;
  } catch {
    session.track.value = null;
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
listenToKeys();
render(<App />, document.getElementById("console")!);
startPainting();
keepAuthority();
listenToAlarms();

const bearer = token();
const scheme = location.protocol === "https:" ? "wss:" : "ws:";
openUplink(`${scheme}//${location.host}/ws${bearer ? `?token=${encodeURIComponent(bearer)}` : ""}`);
void fetchLayouts();

// A base that was started anew may know another track and has forgotten our questions.
effect(() => {
  if (!session.connected.value) return;
  forgetEarlier();
  void fetchTrack();
  void fetchLaterPages();
});
// A jump in time is seen at once, not at the next turn of each painter.
effect(() => {
  if (heldMs.value === null || speed.value === 0) repaint();
});
// The console as a test or a curious engineer may look into it.
Object.assign(window, { pitwall: { session, sounded } });
