/**
 * The cars of this base over everything else, where there are several: of each its number, name,
 * world, link, stop and alarms, whichever is shown. The line below has the colour and the pattern
 * of the one that is shown, on every page.
 */
// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import type { CarSession } from "../store/car_session";
import { showCar } from "../store/cars";
import * as session from "../store/session";
import { AlarmMarks } from "../view/alarm_marks";
import { needsEyes } from "../view/alarm_order";
import { ageText, kDash } from "../view/format";
import { kDigitsHz, usePainter } from "../view/painting";

const kModes = { REAL: "REAL", HIL: "HIL", REPLAY: "REPLAY", NONE: "NO CAR" } as const;
const kLinks = { good: "GOOD", degraded: "DEGRADED", lost: "LOST" } as const;
const kJudged = { good: "good", degraded: "warning", lost: "bad" } as const;

/** The place among the cars decides colour and pattern: 1 to 4. */
const placeOf = (car: CarSession): number => session.cars.value.indexOf(car) + 1;

export function CarChip({ car }: { car: CarSession }) {
  return (
    <b class="car-chip" data-place={placeOf(car)}>
      {car.number}
    </b>
  );
}

function LinkWord({ car }: { car: CarSession }) {
  const root = useRef<HTMLSpanElement>(null);
  usePainter(
    () => {
      if (!root.current) return;
      const local = performance.now();
      const link = car.link.value;
      const silent = !car.connected.value || car.clock.isSilent(local);
      let text: string = link ? kLinks[link.state] : kDash;
      if (silent) text = "NO BASE";
      else if (link?.state === "lost") {
        text = `LOST ${ageText(car.clock.nowMs(local) - link.since_ms)}`;
      }
      const word = root.current.querySelector(".word")!;
      if (word.textContent !== text) word.textContent = text;
      root.current.dataset.judgement = silent ? "bad" : link ? kJudged[link.state] : "none";
    },
    kDigitsHz,
    [car],
  );
  return (
    <span class="tab-link" ref={root} data-judgement="none">
      <span class="state">
        <i class="mark" aria-hidden="true" />
        <span class="word">{kDash}</span>
      </span>
    </span>
  );
}

/** A stop that the car is in, or one that this console could not send to it. */
function StopWord({ car }: { car: CarSession }) {
  const stop = car.stopState.value;
  const unsent = car.lastStop.value?.sent === false;
  if (!stop && !unsent) return null;
  return <b class="tab-stop">{stop ? "STOPPED" : "STOP NOT SENT"}</b>;
}

function Counts({ car }: { car: CarSession }) {
  return (
    <span class="tab-counts">
      <AlarmMarks active={car.alarms.value?.active ?? []} />
    </span>
  );
}

function Tab({ car }: { car: CarSession }) {
  const hello = car.hello.value;
  const alarmed = (car.alarms.value?.active ?? []).some(
    (alarm) => alarm.priority === "high" && needsEyes(alarm),
  );
  return (
    <button
      type="button"
      class="car-tab"
      data-place={placeOf(car)}
      data-car={car.number}
      data-alarmed={alarmed}
      aria-current={car === session.shownCar.value ? "true" : undefined}
      onClick={() => showCar(car)}
    >
      <CarChip car={car} />
      <span class="sr-only">car</span>
      <span class="tab-name">{hello?.name ?? ""}</span>
      <span class="tab-mode">{kModes[hello?.mode ?? "NONE"]}</span>
      <LinkWord car={car} />
      <StopWord car={car} />
      <Counts car={car} />
    </button>
  );
}

export function CarTabs() {
  return (
    <nav class="car-tabs" aria-label="cars" data-place={placeOf(session.shownCar.value)}>
      {session.cars.value.map((car) => (
        <Tab car={car} key={car.number} />
      ))}
    </nav>
  );
}
