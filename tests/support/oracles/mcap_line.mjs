// One message as one line of text: topic, sequence, times, then the values of a decoded message
// (numbers as the bits of a float64) or the bytes of any other.
// SPDX-License-Identifier: Apache-2.0

const hex = (bytes) => Buffer.from(bytes).toString("hex");

function valueText(value) {
  if (value instanceof Uint8Array) return hex(value);
  if (typeof value === "number") {
    const view = new DataView(new ArrayBuffer(8));
    view.setFloat64(0, value);
    return hex(new Uint8Array(view.buffer));
  }
  return String(value);
}

export function line(channel, message, reader) {
  const head = `${channel.topic} ${message.sequence} ${message.logTime} ${message.publishTime}`;
  if (!reader) return `${head} ${hex(message.data)}`;
  const decoded = reader.readMessage(message.data);
  return `${head} ${Object.entries(decoded).map(([k, v]) => `${k}=${valueText(v)}`).join(" ")}`;
}
