/**
 * A link to a page of the bench, which opens beside the console and never in its place. The base
 * serves it as a page that can reach neither the console nor the base.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";

/** Where the base serves a page of the bench server of a car. */
export const pageAddress = (car: number, page: string): string =>
  `/bench/${car}/${page.split("/").map(encodeURIComponent).join("/")}`;

interface Props {
  page: string | null;
  /** On the machine of the bench server. */
  file: string | null;
  text: string;
}

/** The text alone where there is no such page, or nobody to ask for it. */
export function PageLink({ page, file, text }: Props) {
  const car = session.hello.value?.car;
  const up = session.shownCar.value.bench.link.value?.up ?? false;
  if (!page || car === undefined || !up) return <span title={file ?? ""}>{text}</span>;
  return (
    <a
      class="bench-page"
      href={pageAddress(car, page)}
      target="_blank"
      rel="noopener noreferrer"
      title={file ?? ""}
    >
      {text}
    </a>
  );
}
