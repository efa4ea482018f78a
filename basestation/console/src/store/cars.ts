/**
 * Which cars the base has, and a connection for each. The address says which one is shown first
 * (`?car=7`), so that a bookmark is a wall of one car; showing another changes it.
 */
// SPDX-License-Identifier: Apache-2.0
import { CarSession } from "./car_session";
import * as session from "./session";

export interface CarRow {
  number: number;
  name: string;
}

/** The rows of /api/cars out of untrusted JSON; none where it is no such list. */
export function readCars(json: unknown): CarRow[] {
  const rows = (json as { cars?: unknown } | null)?.cars;
  if (!Array.isArray(rows)) return [];
  return rows.flatMap((row: Partial<CarRow> | null) =>
    Number.isInteger(row?.number) ? [{ number: row!.number!, name: String(row!.name ?? "") }] : [],
  );
}

/** The number in the address; null where it names none. */
export function askedCar(search: string): number | null {
  const asked = new URLSearchParams(search).get("car");
  return asked !== null && /^\d{1,3}$/.test(asked) ? Number(asked) : null;
}

const query = (parameters: Record<string, string | number | null>): string => {
  const given = Object.entries(parameters).filter(([, value]) => value !== null);
  return given.length
    ? `?${given.map(([k, v]) => `${k}=${encodeURIComponent(v!)}`).join("&")}`
    : "";
};

function connect(car: CarSession): void {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  car.open(`${scheme}//${location.host}/ws${query({ car: car.number })}`);
}

/** The place of a document of this car. */
export const placeOf = (path: string, car: CarSession): string => path + query({ car: car.number });

async function fetchCars(): Promise<CarRow[]> {
  try {
    const answer = await fetch("api/cars");
    return answer.ok ? readCars(await answer.json()) : [];
  } catch {
    return [];
  }
}

export function showCar(car: CarSession): void {
  session.showCar(car);
  const address = new URL(location.href);
  if (car.number !== null) address.searchParams.set("car", String(car.number));
  history.replaceState(null, "", address);
}

export function showNextCar(): void {
  const { value: cars } = session.cars;
  showCar(cars[(cars.indexOf(session.shownCar.value) + 1) % cars.length]);
}

let known = "";

/** Another base, or an address that names none of its cars: everything begins anew. */
function beginAnew(): void {
  const address = new URL(location.href);
  address.searchParams.delete("car");
  if (address.href === location.href) location.reload();
  else location.replace(address);
}

/** What has begun for one car goes on as its session; the others get theirs. */
function adopt(rows: readonly CarRow[]): void {
  if (rows.length === 0) return;
  const numbers = rows.map((row) => row.number).join();
  const [begun] = session.cars.value;
  const isHere = begun.number === null || rows.some((row) => row.number === begun.number);
  if (!isHere || (known !== "" && numbers !== known)) return beginAnew();
  if (known !== "") return;
  known = numbers;
  if (rows.length === 1) return;
  begun.number ??= rows[0].number;
  session.cars.value = rows.map((row) => {
    if (row.number === begun.number) return begun;
    const car = new CarSession(row.number);
    connect(car);
    return car;
  });
}

/** Connects to the car of the address at once, and to the others as soon as they are known. */
export function openCars(): void {
  const first = session.cars.value[0];
  first.number = askedCar(location.search);
  connect(first);
  // One that is not here never connects.
  if (first.number !== null) void lookForCars();
}

/** Looked up again with each connection. */
export async function lookForCars(): Promise<void> {
  adopt(await fetchCars());
}
