/**
 * The table of a measurement: figures, and which of them have a limit. The exit code is 1 when one
 * misses its limit, 2 for a wrong command line or where the measurement could not go on; --json
 * FILE writes the table.
 */
// SPDX-License-Identifier: Apache-2.0
import { writeFileSync } from "node:fs";
import { machineName } from "../../support/machine.mjs";
import { kBlocks, summary } from "./blocks.mjs";

const thousandths = (figure) => Math.round(figure * 1000) / 1000;
const rounded = (_, value) => (typeof value === "number" ? thousandths(value) : value);
const kNone = "-";

export class Gates {
  rows = [];

  constructor(print = console.log) {
    this.print = print;
  }

  /** A figure that may be as high as its limit. */
  ask(name, figure, limit, unit) {
    const held = figure <= limit;
    this.rows.push({ name, figure, limit, unit, held });
    this.#print(held ? "held" : "MISSED", name, figure, `${unit}, limit ${limit}`);
  }

  /** A figure that is at least so much. */
  need(name, figure, least, unit) {
    const held = figure >= least;
    this.rows.push({ name, figure, least, unit, held });
    this.#print(held ? "held" : "MISSED", name, figure, `${unit}, at least ${least}`);
  }

  say(name, figure, unit) {
    this.rows.push({ name, figure, unit });
    this.#print("", name, figure, unit);
  }

  /** The same of a figure in blocks, see blocks.mjs: of the best one. */
  askBest(name, blocks, figureOf, limit, unit) {
    const of = summary(blocks, figureOf, Math.min);
    const held = (of.best ?? Infinity) <= limit;
    this.#row(name, of, unit, { limit, held }, `, limit ${limit}`);
  }

  needBest(name, blocks, figureOf, least, unit) {
    const of = summary(blocks, figureOf, Math.max);
    const held = (of.best ?? -Infinity) >= least;
    this.#row(name, of, unit, { least, held }, `, at least ${least}`);
  }

  sayBest(name, blocks, figureOf, unit) {
    this.#row(name, summary(blocks, figureOf, Math.min), unit);
  }

  #row(name, { best, undisturbed, disturbed }, unit, bound = {}, words = "") {
    this.rows.push({ name, figure: best, undisturbed, disturbed, unit, ...bound });
    const column = ({ figure, parts }) => `${text(figure)} (${parts})`;
    const beside = `undisturbed ${column(undisturbed)}, disturbed ${column(disturbed)}`;
    const verdict = { true: "held", false: "MISSED" }[bound.held] ?? "";
    this.#print(verdict, name, best, `${unit}${words}; ${beside}`);
  }

  #print(verdict, name, figure, rest) {
    this.print(`  ${verdict.padEnd(7)}${name.padEnd(46)}${text(figure).padStart(9)} ${rest}`);
  }

  get held() {
    return this.rows.every((row) => row.held !== false);
  }
}

/** Of what never came: never; of what was not measured: a dash. */
function text(figure) {
  if (figure === undefined || Number.isNaN(figure)) return kNone;
  return Number.isFinite(figure) ? figure.toFixed(1) : "never";
}

/**
 * Measures as the program `bench` does: the exit code and what the file says. What keeps it from
 * going on is told with what was measured until then.
 */
export async function verdict(bench, measure, print = console.log) {
  const machine = machineName();
  print(`${machine}; the best of ${kBlocks} blocks, and beside it (of how many parts)`);
  const gates = new Gates(print);
  let ended;
  try {
    await measure(gates);
  } catch (error) {
    ended = error.message;
    print(`bench ${bench} could not go on: ${ended}`);
  }
  const { rows, held } = gates;
  const missed = rows.filter((row) => row.held === false).length;
  const judged = rows.some((row) => row.held !== undefined);
  const outcome =
    missed > 0 ? `${missed} of its gates MISSED` : judged ? "all gates held" : "no gate was judged";
  print(
    `${bench}: ${ended === undefined ? outcome : `NOT JUDGED to its end; ${outcome} until then`}`,
  );
  const code = ended === undefined ? (held ? 0 : 1) : 2;
  return { code, file: { bench, machine, rows, ended, held: code === 0 } };
}

/** Runs `measure(gates)` as the program `bench` does. */
export async function judged(bench, measure) {
  const [flag, path, ...more] = process.argv.slice(2);
  if (more.length > 0 || (flag !== undefined && (flag !== "--json" || !path))) {
    console.error("the only argument is --json FILE");
    process.exit(2);
  }
  const { code, file } = await verdict(bench, measure);
  if (path) writeFileSync(path, `${JSON.stringify(file, rounded, 1)}\n`);
  process.exit(code); // what could not be ended may still wait for what never comes
}
