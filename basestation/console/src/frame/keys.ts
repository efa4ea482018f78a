/**
 * The keyboard map. No single key ever sends a command to the car: a controlled stop is Escape
 * twice within 600 ms, an emergency stop the chord Ctrl+Shift+E, a stop of all cars Ctrl+Shift+X.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import * as session from "../store/session";
import { showNextCar } from "../store/cars";
import { isOperator, send, stop, stopAll } from "../store/uplink";
import { nextTheme } from "../theme/theme";
import { inOrder, loudest, needsEyes } from "../view/alarm_order";
import { nextSpeedUnit } from "../view/speed_unit";
import * as transport from "../view/transport";
import { kPages, showPage } from "./pages";
import { shelving } from "./shelve";

export const kDoubleEscapeMs = 600;

export const helpShown = signal(false);
export const finderShown = signal(false);
/** The alarm that `A` acknowledges; none selected means the loudest one. */
export const selectedAlarm = signal<number | null>(null);

export function acknowledge(id: number): void {
  send({ type: "ack", alarm: id });
}

function acknowledgeSelected(): void {
  const active = session.alarms.value?.active ?? [];
  const chosen = active.find((alarm) => alarm.id === selectedAlarm.value) ?? loudest(active);
  if (chosen) acknowledge(chosen.id);
}

export function acknowledgeAll(): void {
  const seen = inOrder(session.alarms.value?.active ?? []).filter(needsEyes);
  if (seen.length > 0) send({ type: "ack", all: seen.map((alarm) => alarm.id) });
}

function shelveSelected(): void {
  const active = session.alarms.value?.active ?? [];
  const chosen = active.find((alarm) => alarm.id === selectedAlarm.value) ?? loudest(active);
  if (chosen && chosen.can_be_shelved !== false && isOperator.value) shelving.value = chosen.id;
}

interface Key {
  keys: string;
  does: string;
  run: (event: KeyboardEvent) => void;
}

/** By `event.key`; what is shown by `?` is this table. */
export const kKeys: Record<string, Key> = {
  a: { keys: "A", does: "acknowledge the selected alarm", run: acknowledgeSelected },
  A: { keys: "Shift+A", does: "acknowledge all alarms shown", run: acknowledgeAll },
  s: { keys: "S", does: "shelve the selected alarm", run: shelveSelected },
  "/": { keys: "/", does: "find a field and plot it", run: () => (finderShown.value = true) },
  " ": { keys: "Space", does: "pause the view or play it", run: transport.togglePlay },
  ArrowLeft: {
    keys: "\u2190 \u2192",
    does: "1 s back or forward, with Shift 10 s",
    run: (e) => transport.step(e.shiftKey ? -10_000 : -1000),
  },
  ArrowRight: { keys: "", does: "", run: (e) => transport.step(e.shiftKey ? 10_000 : 1000) },
  ",": { keys: ", .", does: "one snapshot back or forward", run: () => transport.stepRow(-1) },
  ".": { keys: "", does: "", run: () => transport.stepRow(1) },
  "+": { keys: "+ \u2212", does: "play faster or slower", run: () => transport.changeSpeed(true) },
  "-": { keys: "", does: "", run: () => transport.changeSpeed(false) },
  l: { keys: "L", does: "back to live", run: transport.toEnd },
  m: { keys: "M", does: "mark this moment in the recording", run: () => mark() },
  t: { keys: "T", does: "next theme: dark, light, sun", run: nextTheme },
  u: { keys: "U", does: "next unit of speed", run: nextSpeedUnit },
  c: { keys: "C", does: "show the next car, where there are several", run: () => showNextCar() },
  "?": {
    keys: "?",
    does: "show or hide this list",
    run: () => (helpShown.value = !helpShown.value),
  },
};

export function mark(): void {
  send({ type: "mark", text: `mark of console ${session.hello.value?.client ?? "?"}` });
}

const takesText = (target: EventTarget | null): boolean =>
  target instanceof HTMLElement && target.matches("input, textarea, select, [contenteditable]");
/** Where Space and Enter press what has the focus, and arrows move inside it. */
const takesKeys = (target: EventTarget | null): boolean =>
  target instanceof HTMLElement && target.matches("button, a, summary, [role=grid], [role=slider]");

/** A select that shows its list; browsers that cannot tell keep that Escape to themselves. */
const isListOpen = (): boolean =>
  CSS.supports("selector(select:open)") && document.querySelector("select:open") !== null;

let lastEscapeMs = -Infinity;

/** Closes what lies over the page; false where nothing does. */
function closeDialogs(): boolean {
  const any = helpShown.value || finderShown.value || shelving.value !== null;
  helpShown.value = false;
  finderShown.value = false;
  shelving.value = null;
  return any;
}

/** An Escape that closes a dialog or a list is no half of a stop. */
function escape(): void {
  const now = performance.now();
  if (closeDialogs() || isListOpen()) {
    lastEscapeMs = -Infinity;
    return;
  }
  if (now - lastEscapeMs <= kDoubleEscapeMs) {
    lastEscapeMs = -Infinity;
    stop("controlled");
    return;
  }
  lastEscapeMs = now;
}

function pressed(event: KeyboardEvent): void {
  if (event.ctrlKey && event.shiftKey && event.code === "KeyE") {
    event.preventDefault();
    if (!event.repeat) stop("emergency");
    return;
  }
  if (event.ctrlKey && event.shiftKey && event.code === "KeyX" && session.hasSeveral.value) {
    event.preventDefault();
    if (!event.repeat) stopAll();
    return;
  }
  if (event.key === "Escape") {
    if (!event.repeat) escape();
    return;
  }
  if (event.ctrlKey || event.metaKey || event.altKey || takesText(event.target)) return;
  const moves = event.key === " " || event.key.startsWith("Arrow");
  if (moves && takesKeys(event.target)) return;
  const opened = kPages.find((page) => String(page.key) === event.key);
  if (opened) {
    showPage(opened.name);
    return;
  }
  const key = Object.hasOwn(kKeys, event.key) ? kKeys[event.key] : undefined;
  if (!key) return;
  event.preventDefault();
  key.run(event);
}

/** Listens before anything on the page can swallow a stop. */
export const listenToKeys = (): void => window.addEventListener("keydown", pressed, true);
