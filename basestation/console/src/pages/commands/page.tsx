/**
 * Commands and audit: a command is staged, its gates are shown, and it is sent by holding a button
 * for 600 ms; below, who did what and what became of it.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { AuditPanel } from "./audit";
import { AuthorityPanel } from "./authority";
import { LadderPanel } from "./ladder";
import { ExpectedPanel } from "./expected";
import { StagePanel } from "./stage";

export function CommandsPage() {
  if (session.hello.value?.mode === "REPLAY") {
    return (
      <main class="page commands-page replay">
        <div class="column">
          <AuditPanel />
        </div>
        <div class="column">
          <LadderPanel />
        </div>
      </main>
    );
  }
  return (
    <main class="page commands-page">
      <div class="column">
        <AuthorityPanel />
        <StagePanel />
        <ExpectedPanel />
      </div>
      <div class="column">
        <LadderPanel />
        <AuditPanel />
      </div>
    </main>
  );
}
