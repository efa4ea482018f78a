/**
 * The pages at the left edge, each with its number key, and the theme.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../store/session";
import { nextTheme, theme } from "../theme/theme";
import { nextSpeedUnit, speedUnit } from "../view/speed_unit";
import { needsEyes } from "../view/alarm_order";
import { helpShown } from "./keys";
import { kPages, page, showPage } from "./pages";

export function Navigation() {
  const known = session.presence.value === "here";
  const unseen = !known ? 0 : (session.alarms.value?.active ?? []).filter(needsEyes).length;
  return (
    <nav class="navigation" aria-label="pages">
      {kPages.map(({ key, name, title }) => (
        <button
          type="button"
          key={name}
          aria-current={page.value === name ? "page" : undefined}
          onClick={() => showPage(name)}
        >
          <kbd>{key}</kbd>
          <span>{title}</span>
          {name === "alarms" && unseen > 0 && <b class="badge">{unseen}</b>}
        </button>
      ))}
      <span class="spacer" />
      <button type="button" class="small" onClick={nextSpeedUnit} title="next unit of speed">
        <kbd>U</kbd>
        <span>{speedUnit.value.name}</span>
      </button>
      <button type="button" class="small" onClick={nextTheme} title="next theme">
        <kbd>T</kbd>
        <span>{theme.value}</span>
      </button>
      <button type="button" class="small" onClick={() => (helpShown.value = true)}>
        <kbd>?</kbd>
        <span>keys</span>
      </button>
    </nav>
  );
}
