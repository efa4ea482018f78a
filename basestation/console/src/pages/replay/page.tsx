/**
 * Before and after a run: the check list of the pit and the recordings of the base; while one is
 * played, the moments in it.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { ChecklistPanel } from "./checklist";
import { MomentsPanel } from "./moments";
import { RecordingsPanel } from "./recordings";
import "./replay.css";

export function ReplayPage() {
  const plays = session.hello.value?.mode === "REPLAY";
  return (
    <main class="page replay-page">
      <div class="column">{plays ? <MomentsPanel /> : <ChecklistPanel />}</div>
      <div class="column">
        <RecordingsPanel />
      </div>
    </main>
  );
}
