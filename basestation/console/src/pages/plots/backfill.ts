/**
 * What the base remembers of a field from before this console was opened: asked for once, when the
 * field is plotted.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { send } from "../../store/uplink";
import type { Earlier } from "./series";

const kBackS = 600;
const kPoints = 3000;

const answers = new Map<string, Earlier | null>();

export const earlierOf = (path: string): Earlier | null => answers.get(path) ?? null;

export function requestEarlier(path: string): void {
  if (answers.has(path)) return;
  const store = session.fields.value;
  const info = store.info[store.slot(path)];
  if (!info) return;
  const sent = send({
    type: "history",
    field: info.id,
    from_s: kBackS,
    to_s: 0,
    points: kPoints,
  });
  if (!sent) return;
  answers.set(path, null);
  session.awaitHistory(info.id, (answer) => answers.set(path, answer));
}

/** A new connection or catalogue: what was answered belongs to another base. */
export const forgetEarlier = (): void => answers.clear();
