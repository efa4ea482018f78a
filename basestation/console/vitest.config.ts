/**
 * Unit tests of what needs no browser: decoding, ageing, history, geometry, layouts.
 */
// SPDX-License-Identifier: Apache-2.0
import { defineConfig } from "vitest/config";

export default defineConfig({
  cacheDir: "../../build/console/cache",
  test: { include: ["test/**/*.test.ts"], environment: "node" },
});
