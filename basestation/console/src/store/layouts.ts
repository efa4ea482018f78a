/**
 * Layouts as the base keeps them: read at the start, written when an operator changes one. Where
 * the base refuses or is not there, the layout lasts as long as the page.
 */
// SPDX-License-Identifier: Apache-2.0
import { lastError } from "./session";
import { isOperator } from "./uplink";

const place = (name: string): string => `api/layouts/${encodeURIComponent(name)}`;

const say = (name: string, what: string): void => {
  lastError.value = { place: `layout ${name}`, what, at: performance.now() };
};

/** The kept layout as `read` understands it; null where nobody kept one or it is none. */
export async function fetchLayout<T>(
  name: string,
  read: (json: unknown) => T | null,
): Promise<T | null> {
  try {
    const answer = await fetch(place(name));
    if (answer.status === 204) return null;
    const layout = answer.ok ? read(await answer.json()) : null;
    if (layout === null) say(name, "the saved layout is not valid; the default is shown");
    return layout;
  } catch (error) {
    const isJson = !(error instanceof SyntaxError);
    if (!isJson) say(name, "the saved layout is not JSON; the default is shown");
    return null;
  }
}

export async function storeLayout(name: string, layout: unknown): Promise<void> {
  if (!isOperator.value) return;
  try {
    const answer = await fetch(place(name), {
      method: "PUT",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(layout),
    });
    if (!answer.ok) say(name, (await answer.text()).trim() || `status ${answer.status}`);
  } catch {
    say(name, "no base: kept on this page only");
  }
}
