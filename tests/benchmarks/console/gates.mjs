/**
 * The table of a measurement: figures, and which of them have a limit. The exit code is 1 when one
 * misses its limit, 2 for a wrong command line; --json FILE writes the table.
 */
// SPDX-License-Identifier: Apache-2.0
import { writeFileSync } from "node:fs";

const thousandths = (figure) => Math.round(figure * 1000) / 1000;

export class Gates {
  rows = [];

  /** A figure that may be as high as its limit. */
  ask(name, figure, limit, unit) {
    const held = figure <= limit;
    this.rows.push({ name, figure: thousandths(figure), limit, unit, held });
    this.#print(held ? "held" : "MISSED", name, figure, `${unit}, limit ${limit}`);
  }

  /** A figure that is at least so much. */
  need(name, figure, least, unit) {
    const held = figure >= least;
    this.rows.push({ name, figure: thousandths(figure), least, unit, held });
    this.#print(held ? "held" : "MISSED", name, figure, `${unit}, at least ${least}`);
  }

  say(name, figure, unit) {
    this.rows.push({ name, figure: thousandths(figure), unit });
    this.#print("", name, figure, unit);
  }

  #print(verdict, name, figure, unit) {
    console.log(`  ${verdict.padEnd(7)}${name.padEnd(46)}${figure.toFixed(1).padStart(9)} ${unit}`);
  }

  get held() {
    return this.rows.every((row) => row.held !== false);
  }
}

/** Runs `measure(gates)` as the program `bench` does. */
export async function judged(bench, measure) {
  const [flag, file, ...more] = process.argv.slice(2);
  if (more.length > 0 || (flag !== undefined && (flag !== "--json" || !file))) {
    console.error("the only argument is --json FILE");
    process.exit(2);
  }
  const gates = new Gates();
  await measure(gates);
  const { rows, held } = gates;
  if (file) writeFileSync(file, `${JSON.stringify({ bench, rows, held }, null, 1)}\n`);
  process.exitCode = held ? 0 : 1;
}
