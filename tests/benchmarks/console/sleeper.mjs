/** A console of which the test stops the process: node sleeper.mjs ADDRESS; says when it is in. */
// SPDX-License-Identifier: Apache-2.0
import { Client } from "../../system/console/client.mjs";

await Client.open(process.argv[2]);
console.log("open");
