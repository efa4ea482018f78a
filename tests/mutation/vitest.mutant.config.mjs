/**
 * The console's unit tests with one source replaced by a mutant of it.
 *   in     PITWALL_MUTATED, the source; PITWALL_MUTANT, the file that is read instead
 *   cache  none of modules: a mutant has the name of its source
 */
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";

const { PITWALL_MUTATED: mutated, PITWALL_MUTANT: mutant } = process.env;

export default {
  cacheDir: "../../build/console/cache",
  plugins: [
    {
      name: "mutant",
      enforce: "pre",
      load: (id) => (id === mutated ? readFileSync(mutant, "utf8") : undefined),
    },
  ],
  test: { include: ["test/**/*.test.ts"], environment: "node", fsModuleCache: false },
};
