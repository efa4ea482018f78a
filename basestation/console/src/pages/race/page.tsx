/**
 * The race: flags and round speed as each side has them, roles, attempts and gaps of the passing
 * competition, fuel, and what race control is to be told. Every judgement is the base's; what is
 * stale keeps its age and loses its colour.
 */
// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from "preact";
import { Flag } from "../../frame/flag_tile";
import { race } from "../../store/session";
import { Bar } from "../../view/bar";
import { Line, Tile } from "../../view/value";
import { Notices } from "../link/notices";
import { FuelPanel } from "../primary/fuel_panel";
import { reasonText } from "../primary/limit_words";
import { OpponentPanel } from "./opponents";
import "./race.css";

const kGapShownM = 120;

function FlagRow({ source, children }: { source: string; children: ComponentChildren }) {
  return (
    <div class="flag-row" role="group" aria-label={source}>
      <span class="source">{source}</span>
      {children}
    </div>
  );
}

function FlagsPanel() {
  return (
    <section class="panel" aria-label="flags" tabIndex={0}>
      <h2>Flags</h2>
      <FlagRow source="race control, over CAN">
        <Flag path="flags.track" label="track" />
        <Flag path="flags.vehicle" label="vehicle" />
      </FlagRow>
      <FlagRow source="pit wall, over the base link">
        <Flag path="derived.flag_relayed" label="track" />
      </FlagRow>
      <FlagRow source="what the car acts on">
        <Flag path="flags.track_acted_on" label="track" />
        <Flag path="flags.vehicle_acted_on" label="vehicle" />
      </FlagRow>
      <div class="lines two">
        <Line label="conflict of the three" path="derived.flag_conflict" />
        <Line label="race control's encodings differ" path="flags.conflict" />
        <Line label="heartbeat of race control" path="flags.heartbeat_age" decimals={1} />
        <Line label="link age in the car" path="uplink.link_age" decimals={2} />
      </div>
    </section>
  );
}

function SpeedPanel() {
  return (
    <section class="panel" aria-label="round speed" tabIndex={0}>
      <h2>Round speed</h2>
      <div class="tiles four">
        <Tile label="race control" path="derived.race_control_speed" decimals={0} big />
        <Tile label="announced" path="derived.round_speed_expected" decimals={0} big />
        <Tile label="car's target" path="track.target_speed" decimals={0} big />
        <Tile label="car" path="ego.vx" decimals={0} big />
      </div>
      <div class="lines two">
        <Line label="conflict" path="derived.round_speed_conflict" />
        <Line label="operator's limit" path="planner.operator_limit" decimals={0} />
      </div>
    </section>
  );
}

function AttemptPanel() {
  const rules = race.value;
  return (
    <section class="panel" aria-label="attempt" tabIndex={0}>
      <h2>Attempt</h2>
      <div class="tiles three words">
        <Tile label="role" path="derived.role" big />
        <Tile label="attempt" path="derived.attempt" decimals={0} big />
        <Tile label="state" path="derived.attempt_state" big />
      </div>
      <div class="tiles three">
        <Tile label="laps driven" path="derived.attempt_laps" decimals={2} big />
        <Tile label="laps left" path="derived.attempt_laps_left" decimals={2} big />
        <Tile label="lap" path="track.lap" decimals={0} big />
      </div>
      {rules && (
        <Bar path="derived.attempt_laps" label="laps of the attempt" max={rules.attempt_laps} />
      )}
      <div class="lines two">
        <Line label="role that the car plans by" path="planner.role" />
        <Line label="conflict of the roles" path="derived.role_conflict" />
        <Line label="manoeuvre" path="planner.primitive" />
        <Line label="last lap" path="track.last_lap_time" decimals={2} />
        <Line label="limited by" path="planner.reason" text={reasonText} />
      </div>
    </section>
  );
}

function GapPanel() {
  const passM = race.value?.pass_gap_m;
  const ticks = passM === undefined ? [] : [{ at: passM, label: `${passM} m` }];
  return (
    <section class="panel" aria-label="gap" tabIndex={0}>
      <h2>
        Gap{" "}
        <span class="sum">
          bumper to bumper{passM !== undefined && `; ${passM} m ahead is a pass`}
        </span>
      </h2>
      <div class="tiles three">
        <Tile label="to who is ahead" path="derived.gap_ahead" decimals={1} big />
        <Tile label="to who is behind" path="derived.gap_behind" decimals={1} big />
        <Tile label="closing" path="derived.gap_closing" decimals={1} big />
      </div>
      <div class="gaps">
        <span class="label">ahead</span>
        <Bar path="derived.gap_ahead" label="gap ahead" max={kGapShownM} ticks={ticks} />
        <span class="label">behind</span>
        <Bar path="derived.gap_behind" label="gap behind" max={kGapShownM} ticks={ticks} />
      </div>
      <h3>by race control</h3>
      <div class="lines two">
        <Line label="competitor" path="rival.number" />
        <Line label="rank" path="rival.rank" />
        <Line label="laps" path="rival.laps" />
        <Line label="since the start line" path="rival.lap_distance" decimals={0} />
        <Line label="speed" path="rival.speed" decimals={0} />
      </div>
    </section>
  );
}

export function RacePage() {
  return (
    <main class="page race-page">
      <div class="column">
        <FlagsPanel />
        <SpeedPanel />
      </div>
      <div class="column">
        <AttemptPanel />
        <GapPanel />
      </div>
      <div class="column">
        <section class="panel" aria-label="fuel plan" tabIndex={0}>
          <h2>Fuel plan</h2>
          <FuelPanel />
          <div class="lines">
            <Line label="state" path="derived.fuel_state" />
            <Line label="laps at least" path="derived.fuel_least_laps" decimals={1} />
            <Line label="level at least" path="derived.fuel_least" decimals={1} />
            <Line label="laps, by the car" path="fuel.laps_left" decimals={1} />
          </div>
        </section>
        <OpponentPanel />
        <Notices />
      </div>
    </main>
  );
}
