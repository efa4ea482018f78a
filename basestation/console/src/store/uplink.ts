/**
 * What the operator's hands send to the base. In a replay nothing is sent: there the base has no
 * way to the car, and the console does not pretend.
 */
// SPDX-License-Identifier: Apache-2.0
import { computed, signal } from "@preact/signals";
import { BaseSocket } from "../wire/socket";
import * as session from "./session";

export type StopKind = "controlled" | "emergency";

/** The last stop that was asked for here, and whether it got as far as the base's socket. */
export const lastStop = signal<{ kind: StopKind; sent: boolean; at: number } | null>(null);

export const isOperator = computed(
  () => session.hello.value?.role === "operator" && session.hello.value.mode !== "REPLAY",
);
export const isHolder = computed(
  () =>
    isOperator.value &&
    session.authority.value !== null &&
    session.authority.value.holder === session.hello.value?.client,
);

let socket: BaseSocket | null = null;

export function openUplink(url: string): void {
  socket = new BaseSocket(url, {
    opened: () => (session.connected.value = true),
    closed: () => (session.connected.value = false),
    text: session.takeText,
    binary: (view) => session.takeBinary(view, performance.now()),
    unreadable: () => ++session.counters.badTexts,
  });
  socket.connect();
}

export const send = (message: { type: string } & Record<string, unknown>): boolean =>
  socket?.send(message) ?? false;

export function stop(kind: StopKind): void {
  if (session.hello.value?.mode === "REPLAY") return;
  lastStop.value = { kind, sent: send({ type: "stop", kind }), at: performance.now() };
}

/** Authority lasts three seconds: its holder says each second that it is still there. */
export function keepAuthority(): void {
  setInterval(() => {
    if (isHolder.value) send({ type: "authority", do: "renew" });
  }, 1000);
}
