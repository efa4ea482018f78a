/**
 * How the console is built: one page, hashed names, nothing inlined (the base serves it under
 * `default-src 'self'`), into build/console/dist of the source tree.
 */
// SPDX-License-Identifier: Apache-2.0
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

const fromHere = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
  base: "./",
  cacheDir: fromHere("../../build/console/cache"),
  build: {
    outDir: fromHere("../../build/console/dist"),
    emptyOutDir: true,
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    target: "es2022",
    reportCompressedSize: false,
  },
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
});
