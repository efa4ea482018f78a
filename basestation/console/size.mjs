/**
 * The last step of the build: what a browser loads before it shows the car, gzipped, against its
 * limit of 120 KB, and what follows by itself.
 */
// SPDX-License-Identifier: Apache-2.0
import { readFileSync, readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const kLimitBytes = 120 * 1024;
const dist = fileURLToPath(new URL("../../build/console/dist", import.meta.url));
const text = (name) => readFileSync(join(dist, name), "utf8");

/** The files that the page names, and those without which its scripts do not begin. */
function firstLoad() {
  const first = new Set(["index.html"]);
  const named = [...text("index.html").matchAll(/(?:src|href)="\.\/([^"]+)"/g)].map((m) => m[1]);
  for (const name of named) {
    if (first.has(name)) continue;
    first.add(name);
    if (!name.endsWith(".js")) continue;
    for (const [, at] of text(name).matchAll(/(?:from|import)\s*"\.\/([^"]+)"/g)) {
      named.push(`assets/${at}`);
    }
  }
  for (const name of [...first].filter((at) => at.endsWith(".css"))) {
    for (const [, at] of text(name).matchAll(/url\(\.\/([^)]+)\)/g)) first.add(`assets/${at}`);
  }
  return first;
}

const first = firstLoad();
let total = 0;
let after = 0;
for (const entry of readdirSync(dist, { recursive: true, withFileTypes: true })) {
  if (!entry.isFile()) continue;
  const bytes = readFileSync(join(entry.parentPath, entry.name));
  const packed = Math.min(gzipSync(bytes, { level: 9 }).length, bytes.length);
  const path = join(entry.parentPath, entry.name).slice(dist.length + 1);
  const comesFirst = first.delete(path);
  if (comesFirst) total += packed;
  else after += packed;
  console.log(`${String(packed).padStart(8)} ${comesFirst ? "first" : "later"} ${entry.name}`);
}
console.log(`${String(after).padStart(8)} bytes gzipped follow by themselves`);
console.log(`${String(total).padStart(8)} bytes gzipped in all before, limit ${kLimitBytes}`);
if (first.size > 0) {
  console.error(`not there: ${[...first].join(", ")}`);
  process.exit(1);
}
if (total > kLimitBytes) {
  console.error("the console is larger than its limit");
  process.exit(1);
}
