/**
 * The last step of the build: what a browser loads, gzipped, against its limit of 120 KB.
 */
// SPDX-License-Identifier: Apache-2.0
import { readFileSync, readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const kLimitBytes = 120 * 1024;
const dist = fileURLToPath(new URL("../../build/console/dist", import.meta.url));

let total = 0;
for (const entry of readdirSync(dist, { recursive: true, withFileTypes: true })) {
  if (!entry.isFile()) continue;
  const bytes = readFileSync(join(entry.parentPath, entry.name));
  const packed = Math.min(gzipSync(bytes, { level: 9 }).length, bytes.length);
  total += packed;
  console.log(`${String(packed).padStart(8)} ${entry.name}`);
}
console.log(`${String(total).padStart(8)} bytes gzipped in all, limit ${kLimitBytes}`);
if (total > kLimitBytes) {
  console.error("the console is larger than its limit");
  process.exit(1);
}
