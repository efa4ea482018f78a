/**
 * Pages that the first load leaves out: fetched as soon as the first values are drawn, so that they
 * are there when the base is not, and once more when the connection comes back.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import type { FunctionComponent } from "preact";

const kFailed =
  "This page has not come from the base. It is asked for again when the base answers; a base " +
  "that was built anew needs this window to be loaded again.";

type Load = () => Promise<FunctionComponent>;

/** Those that are not here yet. */
const missing = new Set<() => Promise<void>>();

/** A page that is fetched when it is shown, or before. */
export function later(load: Load): FunctionComponent {
  const body = signal<FunctionComponent | null>(null);
  const failed = signal(false);
  let asked = false;
  const fetchIt = async (): Promise<void> => {
    if (asked) return;
    asked = true;
    try {
      body.value = await load();
      missing.delete(fetchIt);
    } catch {
      asked = false;
      failed.value = true;
    }
  };
  missing.add(fetchIt);
  return function Later() {
    const Body = body.value;
    if (Body) return <Body />;
    void fetchIt();
    return (
      <main class="page">
        <p class="empty" role="status">
          {failed.value ? kFailed : "This page is on its way."}
        </p>
      </main>
    );
  };
}

/** Fetches what is missing, one after the other: what is drawn comes first. */
export async function fetchLaterPages(): Promise<void> {
  for (const fetchIt of [...missing]) await fetchIt();
}
