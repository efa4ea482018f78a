/**
 * The whole console: the fixed frame and the page in it. The frame's border says in which world we
 * are: none for the real car, dashed blue for the bench, hatched for a replay, amber for the past.
 * Another car has other elements: a press that has begun on one car does not end on another.
 */
// SPDX-License-Identifier: Apache-2.0
import type { FunctionComponent } from "preact";
import { AlarmLine } from "./frame/alarm_line";
import { CarTabs } from "./frame/car_tabs";
import { DvrBar } from "./frame/dvr_bar";
import { Finder } from "./frame/finder";
import { Help } from "./frame/help";
import { finderShown, helpShown } from "./frame/keys";
import { later } from "./frame/later";
import { Login } from "./frame/login";
import { Navigation } from "./frame/navigation";
import { SilenceBand } from "./frame/silence_band";
import { page } from "./frame/pages";
import type { PageName } from "./frame/pages";
import { ReplayBar } from "./frame/replay_bar";
import { ShelveDialog, shelving } from "./frame/shelve";
import { StopCard } from "./frame/stop_card";
import { StopRail } from "./frame/stop_rail";
import { TopBar } from "./frame/top_bar";
import { AlarmsPage } from "./pages/alarms/page";
import { CommandsPage } from "./pages/commands/page";
import { LinkPage } from "./pages/link/page";
import { PrimaryPage } from "./pages/primary/page";
import { TelemetryPage } from "./pages/telemetry/page";
import { loginNeeded } from "./store/login";
import * as session from "./store/session";
import { isLive } from "./view/timeline";

/** What one must be able to do at once is in the first load; the rest follows by itself. */
const kBodies: Record<PageName, FunctionComponent> = {
  primary: PrimaryPage,
  plots: later(() => import("./pages/plots/page").then((it) => it.PlotsPage)),
  telemetry: TelemetryPage,
  link: LinkPage,
  commands: CommandsPage,
  alarms: AlarmsPage,
  race: later(() => import("./pages/race/page").then((it) => it.RacePage)),
  hil: later(() => import("./pages/hil/page").then((it) => it.HilPage)),
  events: later(() => import("./pages/events/page").then((it) => it.EventsPage)),
  replay: later(() => import("./pages/replay/page").then((it) => it.ReplayPage)),
};

export function App() {
  if (loginNeeded.value) return <Login />;
  return <Frame />;
}

function Frame() {
  const Body = kBodies[page.value];
  const mode = session.hello.value?.mode ?? "NONE";
  const { number } = session.shownCar.value;
  return (
    <div
      class="frame"
      data-mode={mode}
      data-held={!isLive.value}
      data-connected={session.connected.value}
      data-presence={session.presence.value}
      data-several={session.hasSeveral.value}
    >
      {session.hasSeveral.value && <CarTabs />}
      <TopBar key={`bar${number}`} />
      <SilenceBand />
      <Navigation />
      <div class="page-box">
        <Body key={`page${number}`} />
      </div>
      <StopCard key={`card${number}`} />
      <StopRail key={`stops${number}`} />
      <AlarmLine key={`alarms${number}`} />
      {mode === "REPLAY" ? <ReplayBar /> : <DvrBar />}
      {helpShown.value && <Help />}
      {finderShown.value && <Finder />}
      {shelving.value !== null && <ShelveDialog key={shelving.value} />}
    </div>
  );
}
