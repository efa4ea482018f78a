/**
 * Layouts as the base keeps them: read at the start, written when an operator changes one. Where
 * the base refuses or is not there, the layout lasts as long as the page.
 */
// SPDX-License-Identifier: Apache-2.0
import { isOperator } from "./uplink";

const place = (name: string): string => `api/layouts/${encodeURIComponent(name)}`;

export async function fetchLayout(name: string): Promise<unknown> {
  try {
    const answer = await fetch(place(name));
    return answer.ok ? await answer.json() : null;
  } catch {
    return null;
  }
}

export function storeLayout(name: string, layout: unknown): void {
  if (!isOperator.value) return;
  fetch(place(name), {
    method: "PUT",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(layout),
  }).catch(() => {});
}
