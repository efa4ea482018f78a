/**
 * The npm packages of the tests lie with the console's own: one lock file for both.
 */
// SPDX-License-Identifier: Apache-2.0
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

export const kRoot = fileURLToPath(new URL("../../../", import.meta.url));
const require = createRequire(`${kRoot}basestation/console/package.json`);

export const { chromium } = require("playwright-core");
export const { WebSocketServer, WebSocket } = require("ws");
export const kAxe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
