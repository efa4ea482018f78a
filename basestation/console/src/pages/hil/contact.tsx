/**
 * The contact with another car that ended a run: who, when, where, how fast, who caused it and by
 * which rule. Judged by the bench, not here; the picture of it is on the run's report.
 */
// SPDX-License-Identifier: Apache-2.0
import { fixed, kDash } from "../../view/format";
import { speedUnit } from "../../view/speed_unit";
import type { CarContact } from "../../wire/bench";

const metres = (value: number | null, decimals: number): string =>
  typeof value === "number" ? `${fixed(value, decimals)} m` : kDash;

function speedText(mps: number | null): string {
  const { name, perMps } = speedUnit.value;
  return typeof mps === "number" ? `${fixed(mps * perMps, 0)} ${name}` : kDash;
}

export function causeText(contact: CarContact): string {
  if (contact.caused && contact.caused_by_other) return "BOTH CARS";
  if (contact.caused) return "THIS CAR";
  return contact.caused_by_other ? otherText(contact) : "NEITHER";
}

const otherText = (contact: CarContact): string => `${contact.with} (${contact.with_number})`;

export function ContactPanel({ contact }: { contact: CarContact }) {
  const { own, other } = contact;
  const figures: [string, string][] = [
    ["with", otherText(contact)],
    ["how", contact.kind],
    ["at", `${fixed(contact.at_s, 2)} s`],
    ["station", metres(contact.s_m, 0)],
    ["speed", speedText(own.speed_mps)],
    ["speed of the other", speedText(other.speed_mps)],
    ["closing", speedText(contact.closing_mps)],
    ["offset", metres(own.n_m, 1)],
    ["offset of the other", metres(other.n_m, 1)],
  ];
  return (
    <section class="panel contact" aria-label="contact with another car" tabIndex={0}>
      <h2>
        Contact with another car
        <span class="sum">
          caused by <b data-standing={contact.caused ? "failed" : "holds"}>{causeText(contact)}</b>
        </span>
      </h2>
      <p class="rule">{contact.rule}</p>
      <dl class="figures">
        {figures.map(([label, text]) => (
          <div key={label}>
            <dt>{label}</dt>
            <dd>{text}</dd>
          </div>
        ))}
      </dl>
    </section>
  );
}
