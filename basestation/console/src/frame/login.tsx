/**
 * In place of everything, where the base asks who comes: a field for the token of this person.
 */
// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { logIn, loginProblem, logOut, visitor } from "../store/login";

const beginAnew = (may: boolean): void => {
  if (may) location.reload();
};

export function Login() {
  const [token, setToken] = useState("");
  return (
    <div class="login" role="dialog" aria-label="log in" aria-modal="true">
      <form
        onSubmit={(e) => {
          e.preventDefault();
          void logIn(token.trim()).then(beginAnew);
        }}
      >
        <h1>Pitwall</h1>
        <p>This base asks who you are before it shows a car or takes a stop from here.</p>
        <label>
          your token
          <input
            type="password"
            name="token"
            value={token}
            autocomplete="current-password"
            autofocus
            required
            onInput={(e) => setToken(e.currentTarget.value)}
          />
        </label>
        {loginProblem.value && <p role="alert">{loginProblem.value}</p>}
        <button type="submit">Log in</button>
      </form>
    </div>
  );
}

/** Who is logged in here, and the way out. */
export function LoggedIn() {
  const who = visitor.value;
  if (!who?.logged_in) return null;
  return (
    <p class="logged-in">
      Logged in as {who.name} ({who.role}).{" "}
      <button type="button" onClick={() => void logOut().then(beginAnew)}>
        Log out
      </button>
    </p>
  );
}
