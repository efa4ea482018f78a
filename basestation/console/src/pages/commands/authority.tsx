/**
 * Who may command the car. One console holds the authority; another takes it when it is free, or
 * asks and is granted. Stopping needs none.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { isHolder, isOperator, send } from "../../store/uplink";

type Action = "take" | "drop" | "request" | "grant" | "refuse";

const act = (action: Action, to?: number) =>
  send({ type: "authority", do: action, ...(to ? { to } : {}) });

export function AuthorityPanel() {
  const authority = session.authority.value;
  const hello = session.hello.value;
  const held = Boolean(authority?.holder);
  const request = authority?.request ?? null;
  const asker =
    request?.by === hello?.client ? "This console" : request?.name || `Console ${request?.by}`;
  return (
    <section class="panel authority" aria-label="authority" tabIndex={0}>
      <h2>Authority</h2>
      <p class="who">
        {held
          ? isHolder.value
            ? "This console commands the car."
            : `${authority?.holder_name || `Console ${authority?.holder}`} commands the car.`
          : "Nobody commands the car."}
        <span class="sum"> epoch {authority?.epoch ?? 0}</span>
      </p>
      {isOperator.value ? (
        <div class="tools">
          {!held && (
            <button type="button" onClick={() => act("take")}>
              Take authority
            </button>
          )}
          {held && !isHolder.value && (
            <button
              type="button"
              disabled={request?.by === hello?.client}
              onClick={() => act("request")}
            >
              {request?.by === hello?.client ? "Asked, waiting" : "Ask for authority"}
            </button>
          )}
          {isHolder.value && (
            <button type="button" onClick={() => act("drop")}>
              Give it up
            </button>
          )}
        </div>
      ) : (
        <p class="empty">This console is a viewer.</p>
      )}
      {!isHolder.value && request && (
        <p role="status">{asker} asks; granted where nobody refuses.</p>
      )}
      {isHolder.value && request && (
        <div class="request" role="alert">
          <p>{request.name || `Console ${request.by}`} asks for the authority.</p>
          <div class="tools">
            <button type="button" onClick={() => act("grant", request.by)}>
              Grant
            </button>
            <button type="button" onClick={() => act("refuse", request.by)}>
              Refuse
            </button>
          </div>
        </div>
      )}
    </section>
  );
}
