/**
 * Layouts as the base keeps them: read at the start, written when an operator changes one. Where
 * the base refuses or is not there, the layout lasts as long as the page.
 */
// SPDX-License-Identifier: Apache-2.0
import { lastError } from "./session";
import { isOperator } from "./uplink";

const place = (name: string): string => `api/layouts/${encodeURIComponent(name)}`;

/** The token with which this page was opened, for a base that asks for one. */
export const token = (): string | null => new URLSearchParams(location.search).get("token");

export async function fetchLayout(name: string): Promise<unknown> {
  try {
    const answer = await fetch(place(name));
    return answer.status === 200 ? await answer.json() : null;
  } catch {
    return null;
  }
}

const say = (what: string): void => {
  lastError.value = { place: "layout", what, at: performance.now() };
};

export async function storeLayout(name: string, layout: unknown): Promise<void> {
  if (!isOperator.value) return;
  const bearer = token();
  try {
    const answer = await fetch(place(name), {
      method: "PUT",
      headers: {
        "Content-Type": "application/json",
        ...(bearer ? { Authorization: `Bearer ${bearer}` } : {}),
      },
      body: JSON.stringify(layout),
    });
    if (!answer.ok) say((await answer.text()).trim() || `status ${answer.status}`);
  } catch {
    say("no base: kept on this page only");
  }
}
