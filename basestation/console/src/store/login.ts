/**
 * Who this browser is to the base. A base that binds tokens answers 401 until somebody has logged
 * in; the browser then holds a cookie that no script reads.
 */
// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";

const kPlace = "api/session";
const kUnauthorized = 401;

export interface Visitor {
  role: string;
  name: string;
  logged_in: boolean;
}

/** Null: not known yet, or not logged in. */
export const visitor = signal<Visitor | null>(null);
export const loginNeeded = signal(false);
/** Why the last login failed; empty: it did not. */
export const loginProblem = signal("");

/** Asks the base; where it does not answer, what was known stays. */
export async function lookForVisitor(): Promise<void> {
  try {
    const answer = await fetch(kPlace);
    if (answer.status === kUnauthorized) {
      visitor.value = null;
      loginNeeded.value = true;
    } else if (answer.ok) {
      visitor.value = (await answer.json()) as Visitor;
      loginNeeded.value = false;
    }
  } catch {
    // No base: who connects asks again.
  }
}

/** True: the page may begin anew as who has logged in. */
export async function logIn(token: string): Promise<boolean> {
  try {
    const answer = await fetch(kPlace, { method: "POST", body: JSON.stringify({ token }) });
    loginProblem.value = answer.ok ? "" : (await answer.text()).trim();
    return answer.ok;
  } catch {
    loginProblem.value = "the base does not answer";
    return false;
  }
}

export async function logOut(): Promise<boolean> {
  try {
    return (await fetch(kPlace, { method: "DELETE" })).ok;
  } catch {
    return false;
  }
}
