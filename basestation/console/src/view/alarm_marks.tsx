/** How many alarms of each priority are active, and whether one of them waits to be seen. */
// SPDX-License-Identifier: Apache-2.0
import type { Alarm } from "../wire/messages";
import { countOf, kPriorities, needsEyes } from "./alarm_order";

export function AlarmMarks({ active }: { active: readonly Alarm[] }) {
  return (
    <>
      {kPriorities.map((priority) => {
        const count = countOf(active, priority);
        const unseen = active.some((a) => a.priority === priority && needsEyes(a));
        return (
          <span
            key={priority}
            class={`count ${priority}`}
            data-some={count > 0}
            data-unseen={unseen}
          >
            <i class="mark" aria-hidden="true" />
            {count}
            <span class="sr-only"> {priority} alarms</span>
          </span>
        );
      })}
    </>
  );
}
