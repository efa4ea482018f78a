/**
 * A console without a screen: a WebSocket of its own on the base, what it was told kept by type,
 * its frames counted. It renews nothing by itself, and stops reading where the test wants it to.
 */
// SPDX-License-Identifier: Apache-2.0
import { WebSocket } from "./packages.mjs";

/** How long a test waits for what must come: no bound of ours, only the end of hope. */
export const kPatienceMs = 120_000;

/** Resolves with what `test` returns once that is something; fails with what it waited for. */
export async function eventually(what, test) {
  for (const end = Date.now() + kPatienceMs; Date.now() < end;) {
    const found = await test();
    if (found) return found;
    await new Promise((done) => setTimeout(done, 10));
  }
  throw new Error(`waited ${kPatienceMs} ms in vain for: ${what}`);
}

export class Client {
  /** Texts in order, the newest of each type, and the newest frame's header. */
  texts = [];
  newest = {};
  frames = 0;
  dropped = 0;

  /** `query`: which car, for example "?car=8". `token`: of a base that asks for one. */
  static async open(address, client = new Client(), query = "", token = undefined) {
    const headers = token ? { Authorization: `Bearer ${token}` } : {};
    client.socket = new WebSocket(`${address.replace("http", "ws")}/ws${query}`, { headers });
    client.socket.on("message", (data, isBinary) => client.take(data, isBinary));
    client.socket.on("error", (error) => (client.failed = error));
    await client.until("hello", () => {
      if (client.failed) throw client.failed;
      return client.newest.hello;
    });
    return client;
  }

  take(data, isBinary) {
    if (isBinary) {
      ++this.frames;
      this.dropped = data.readUInt32LE(12);
      return;
    }
    const text = JSON.parse(String(data));
    this.texts.push(text);
    this.newest[text.type] = text;
  }

  say(message) {
    this.socket.send(JSON.stringify(message));
  }

  count(type) {
    return this.texts.filter((text) => text.type === type).length;
  }

  /** Resolves with what `test` gives once that is true. */
  until = eventually;

  close() {
    this.socket.terminate();
  }
}
