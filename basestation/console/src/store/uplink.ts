/**
 * What the operator's hands send to the base: to the car that is shown, on that car's own
 * connection, or a stop to all of them, to each on its own. In a replay nothing is sent: there the
 * base has no way to the car, and the console does not pretend.
 */
// SPDX-License-Identifier: Apache-2.0
import { computed } from "@preact/signals";
import type { StopKind } from "./car_session";
import * as session from "./session";

export type { StopKind };

export const lastStop = computed(() => session.shownCar.value.lastStop.value);
export const isOperator = computed(() => session.shownCar.value.isOperator.value);
export const isHolder = computed(() => session.shownCar.value.isHolder.value);

export const send = (message: { type: string } & Record<string, unknown>): boolean =>
  session.shownCar.value.send(message);

/** A controlled stop of every car of the base. */
export const stopAll = (): void => session.cars.value.forEach((car) => car.stop("controlled"));

export const stop = (kind: StopKind): void => session.shownCar.value.stop(kind);

/**
 * Authority lasts three seconds: its holder says each second that it is still there, for each car
 * that it commands, whichever is shown.
 */
export function keepAuthority(): void {
  setInterval(() => {
    for (const car of session.cars.value) {
      if (car.isHolder.value) car.send({ type: "authority", do: "renew" });
    }
  }, 1000);
}
