/**
 * The fixed bar over every page: which car in which world, flags, speeds of the round, what the
 * car does, the link, who commands, alarms, time. Of the present moment always.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import * as session from "../store/session";
import { AlarmMarks } from "../view/alarm_marks";
import { clockText, kDash } from "../view/format";
import { kDigitsHz, kEachFrame, lastPaintMs, usePainter } from "../view/painting";
import { nextSpeedUnit } from "../view/speed_unit";
import { isSilent, liveMs } from "../view/timeline";
import { Value } from "../view/value";
import { Flag } from "./flag_tile";
import { LinkTile } from "./link_tile";
import { ModeWord } from "./mode_word";
import { showPage } from "./pages";

function AlarmCounts() {
  const known = session.presence.value === "here";
  return (
    <button type="button" class="alarm-counts" onClick={() => showPage("alarms")} title="alarms">
      {known ? (
        <AlarmMarks active={session.alarms.value?.active ?? []} />
      ) : (
        <span class="count">alarms {kDash}</span>
      )}
    </button>
  );
}

function Holder() {
  const authority = session.authority.value;
  const hello = session.hello.value;
  const mine = authority && hello && authority.holder === hello.client;
  const known = session.presence.value !== "gone";
  const request = known ? authority?.request : null;
  const name =
    !authority || !known
      ? kDash
      : !authority.holder
        ? "nobody"
        : mine
          ? "this console"
          : authority.holder_name || `console ${authority.holder}`;
  return (
    <button
      type="button"
      class="top-tile holder"
      data-mine={Boolean(known && mine)}
      data-asked={Boolean(request)}
      onClick={() => showPage("commands")}
    >
      <span class="label">{request ? `${request.name} asks` : "Authority"}</span>
      <span class="word">{name}</span>
    </button>
  );
}

function Clocks() {
  const root = useRef<HTMLDivElement>(null);
  usePainter(
    () => {
      const [detail, time] = root.current?.children ?? [];
      if (!time) return;
      const [draws, lost] = detail.children;
      const { dropped } = session.counters;
      time.textContent = isSilent() ? kDash : clockText(session.clock.utcMs(liveMs()));
      const whose = session.benchTime.value ? "bench UTC" : "UTC";
      draws.textContent = `${whose} \u00b7 draws in ${lastPaintMs.toFixed(1)} ms`;
      lost.textContent = dropped > 0 ? `${dropped} lost` : "";
    },
    kDigitsHz,
    [],
  );
  return (
    <div class="top-tile clocks" ref={root}>
      <span class="detail">
        <span class="draws" />
        <span
          class="lost"
          title="pictures that the base dropped because this console did not read"
        />
      </span>
      <span class="word">{kDash}</span>
    </div>
  );
}

export function TopBar() {
  return (
    <header class="top-bar">
      <ModeWord />
      <Flag path="flags.track" label="Track flag" />
      <Flag path="flags.vehicle" label="Car flag" />
      <button
        type="button"
        class="top-tile round"
        onClick={nextSpeedUnit}
        title="round speed of race control; press for another unit"
      >
        <span class="label">Round</span>
        <span class="pair">
          <Value path="flags.round_target_speed" decimals={0} live hz={kEachFrame} />
          <span class="of announced" title="as it was announced to us">
            <Value
              path="derived.round_speed_expected"
              decimals={0}
              unit={false}
              live
              hz={kEachFrame}
            />
          </span>
          <span class="of limit" title="limit set by the operator">
            <Value path="planner.operator_limit" decimals={0} unit={false} live hz={kEachFrame} />
          </span>
        </span>
      </button>
      <div class="top-tile car-state" role="group" aria-label="Car">
        <span class="label">Car</span>
        <Value path="mode.mode" live hz={kEachFrame} class="word" />
      </div>
      <LinkTile />
      <Holder />
      <AlarmCounts />
      <Clocks />
    </header>
  );
}
