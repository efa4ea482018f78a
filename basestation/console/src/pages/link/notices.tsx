/**
 * Messages for race control: the base drafts them with their evidence, a person reads them out or
 * copies them, and says that race control has them. The base itself sends nothing to race control.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import * as session from "../../store/session";
import { isOperator, send } from "../../store/uplink";
import { clockText } from "../../view/format";
import { inDisplayUnits } from "../../view/display_units";
import type { Notice } from "../../wire/messages";

const kFates = { draft: "to be reported", reported: "reported", dismissed: "not needed" } as const;

/** Clipboards may be refused, and exist only where the page came by TLS or from this machine. */
async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

function Draft({ notice }: { notice: Notice }) {
  const [copied, setCopied] = useState("");
  const answer = (what: "reported" | "dismiss") =>
    send({ type: "notice", id: notice.id, do: what });
  const text = `${inDisplayUnits(notice.text)} (${inDisplayUnits(notice.evidence)})`;
  return (
    <article class="notice" data-state="draft">
      <h3>
        Read out to race control <small>radio {notice.kind}</small>
      </h3>
      <p class="read-out">{inDisplayUnits(notice.text)}</p>
      <p class="evidence">{inDisplayUnits(notice.evidence)}</p>
      <div class="tools">
        <button
          type="button"
          onClick={() =>
            void copy(text).then((done) => setCopied(done ? "copied" : "refused: select the text"))
          }
        >
          Copy
        </button>
        {isOperator.value && (
          <>
            <button type="button" onClick={() => answer("reported")}>
              Reported to race control
            </button>
            <button type="button" onClick={() => answer("dismiss")}>
              Not needed
            </button>
          </>
        )}
        <span role="status">{copied}</span>
      </div>
    </article>
  );
}

function Settled({ notice }: { notice: Notice }) {
  return (
    <li data-state={notice.state}>
      {clockText(session.clock.utcMs(notice.time_ms))} radio {notice.kind}: {kFates[notice.state]}
      {notice.by ? ` by ${notice.by}` : ""}
    </li>
  );
}

export function Notices() {
  const notices = session.notices.value;
  const drafts = notices.filter((notice) => notice.state === "draft");
  const settled = notices.filter((notice) => notice.state !== "draft").reverse();
  return (
    <section class="panel" aria-label="for race control" tabIndex={0}>
      <h2>For race control</h2>
      {drafts.map((notice) => (
        <Draft notice={notice} key={notice.id} />
      ))}
      {notices.length === 0 && <p class="empty">No notices.</p>}
      <ul class="settled">
        {settled.map((notice) => (
          <Settled notice={notice} key={notice.id} />
        ))}
      </ul>
    </section>
  );
}
