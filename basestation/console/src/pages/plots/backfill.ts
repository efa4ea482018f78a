/**
 * What the base remembers of a field from before this console was opened: asked for once, when the
 * field is plotted.
 */
// SPDX-License-Identifier: Apache-2.0
import type { CarSession } from "../../store/car_session";
import * as session from "../../store/session";
import type { Earlier } from "./series";

const kBackS = 600;
const kPoints = 3000;
/** Of a recording, whose older rows this console has not seen played. */
const kRecordedPoints = 12_000;

const answers = new Map<string, Earlier | null>();

const keyOf = (path: string, car: CarSession): string => `${car.number} ${path}`;

export const earlierOf = (path: string, car: CarSession): Earlier | null =>
  answers.get(keyOf(path, car)) ?? null;

export function requestEarlier(path: string, car = session.shownCar.value): void {
  const key = keyOf(path, car);
  if (answers.has(key)) return;
  const store = car.fields.value;
  const info = store.info[store.slot(path)];
  if (!info) return;
  const sent = car.send({
    type: "history",
    field: info.id,
    from_s: kBackS,
    to_s: 0,
    points: car.playback.value ? kRecordedPoints : kPoints,
  });
  if (!sent) return;
  answers.set(key, null);
  car.awaitHistory(info.id, (answer) => answers.set(key, answer));
}

/** A new connection, or a jump of a replay: what was answered lies elsewhere. */
export const forgetEarlier = (): void => answers.clear();
