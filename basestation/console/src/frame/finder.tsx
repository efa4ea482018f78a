/**
 * Finds any field by a few letters of its title or its path; Enter plots it.
 */
// SPDX-License-Identifier: Apache-2.0
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import * as session from "../store/session";
import { plotTarget } from "../pages/plots/finder_target";
import { findFields } from "../view/find_fields";
import { Value } from "../view/value";
import { finderShown } from "./keys";
import { showPage } from "./pages";

const kShown = 12;

function choose(path: string): void {
  finderShown.value = false;
  plotTarget.add(plotTarget.chart, path);
  showPage("plots");
}

export function Finder() {
  const input = useRef<HTMLInputElement>(null);
  const [query, setQuery] = useState("");
  const [at, setAt] = useState(0);
  // Before the next key can come: what is typed after "/" belongs here.
  useLayoutEffect(() => {
    const before = document.activeElement as HTMLElement | null;
    input.current?.focus();
    return () => {
      plotTarget.chart = null;
      before?.focus?.();
    };
  }, []);
  const hits = findFields(session.fields.value.info, query).slice(0, kShown);
  const chosen = hits[Math.min(at, hits.length - 1)];
  return (
    <div class="veil" onClick={() => (finderShown.value = false)}>
      <div
        class="dialog finder"
        role="dialog"
        aria-modal="true"
        aria-label="find a field"
        onClick={(e) => e.stopPropagation()}
      >
        <input
          ref={input}
          type="text"
          role="combobox"
          aria-expanded="true"
          spellcheck={false}
          aria-controls="found"
          aria-autocomplete="list"
          aria-label="field to plot"
          aria-activedescendant={chosen ? `found-${chosen.id}` : undefined}
          placeholder="find a field, Enter plots it"
          value={query}
          onInput={(e) => {
            setQuery(e.currentTarget.value);
            setAt(0);
          }}
          onKeyDown={(e) => {
            if (e.key === "ArrowDown") setAt(Math.min(at + 1, hits.length - 1));
            else if (e.key === "ArrowUp") setAt(Math.max(at - 1, 0));
            else if (e.key === "Enter" && chosen) choose(chosen.path);
            else return;
            e.preventDefault();
          }}
        />
        <ul id="found" role="listbox" aria-label="fields found">
          {hits.map((field) => (
            <li
              key={field.id}
              id={`found-${field.id}`}
              role="option"
              aria-selected={field === chosen}
              onClick={() => choose(field.path)}
            >
              <span class="title">{field.title}</span>
              <span class="path">{field.path}</span>
              <Value path={field.path} />
            </li>
          ))}
        </ul>
        {hits.length === 0 && (
          <p class="empty" role="status">
            no field of this name
          </p>
        )}
      </div>
    </div>
  );
}
