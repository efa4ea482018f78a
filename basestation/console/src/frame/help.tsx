/**
 * The list of keys, as the keyboard map has them.
 */
// SPDX-License-Identifier: Apache-2.0
import { helpShown, kDoubleEscapeMs, kKeys } from "./keys";
import { LoggedIn } from "./login";
import { kPages } from "./pages";
import { kEmergencyHoldMs } from "./stop_rail";
import { hasSeveral } from "../store/session";
import { runsText } from "../view/format";

export function Help() {
  const rows = Object.values(kKeys).filter((key) => key.keys !== "");
  return (
    <div class="veil" onClick={() => (helpShown.value = false)}>
      <div
        class="dialog help"
        role="dialog"
        aria-modal="true"
        aria-label="keys"
        onClick={(e) => e.stopPropagation()}
      >
        <h2>Keys</h2>
        <table class="readings wide">
          <tbody>
            <tr class="stops">
              <th scope="row">
                <kbd>Esc Esc</kbd>
              </th>
              <td>controlled stop (twice within {kDoubleEscapeMs} ms)</td>
            </tr>
            <tr class="stops">
              <th scope="row">
                <kbd>Ctrl Shift E</kbd>
              </th>
              <td>emergency stop (or hold the button {kEmergencyHoldMs} ms)</td>
            </tr>
            {hasSeveral.value && (
              <tr class="stops">
                <th scope="row">
                  <kbd>Ctrl Shift X</kbd>
                </th>
                <td>controlled stop of all cars</td>
              </tr>
            )}
            <tr>
              <th scope="row">
                <kbd>{runsText(kPages.map((page) => page.key))}</kbd>
              </th>
              <td>{kPages.map((page) => page.title).join(", ")}</td>
            </tr>
            {rows.map((key) => (
              <tr key={key.keys}>
                <th scope="row">
                  <kbd>{key.keys}</kbd>
                </th>
                <td>{key.does}</td>
              </tr>
            ))}
            <tr>
              <th scope="row">
                <kbd>Alt + arrows</kbd>
              </th>
              <td>move the panel that has the focus (primary page)</td>
            </tr>
          </tbody>
        </table>
        <LoggedIn />
        <button type="button" autofocus onClick={() => (helpShown.value = false)}>
          Close
        </button>
      </div>
    </div>
  );
}
