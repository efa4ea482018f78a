// A trace of the vehicle"s state as signed MAVLink 2, written by node-mavlink: the bytes of its
// datagrams and the time that it takes.
//   in     argument: a JSON file {"fields": [{name, min, max, resolution}], "frames": [[value]]}
//   out    standard output: JSON, for each form of the dialect {payload, datagram, largest,
//          encode_ns, decode_ns}; bytes are means over the trace, `datagram` without IP and UDP
//   law    two messages of 50 fields each in one datagram, each with its header, checksum and
//          signature; fields in the order of MAVLink, widest first; zeros at a payload's end are
//          not sent. Every datagram is read again and its values compared
//   forms  decimal: whole numbers of a power of ten of the unit, as the dialects of MAVLink have
//          them (cm, dV, ...), not coarser than our resolution, in the narrowest type
//          squeezed: our own steps and offsets, in the narrowest type; no dialect does so
//          float: each number a float, each label and flag an uint8_t, bits an uint32_t
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { performance } from "node:perf_hooks";
import { isDeepStrictEqual } from "node:util";
import mappings from "mavlink-mappings";
import mavlink from "node-mavlink";

const { MavLinkData, MavLinkPacketField } = mappings;
const { DESERIALIZERS, MavLinkPacketSignature, MavLinkProtocolV2 } = mavlink;

const kPerMessage = 50, kFirstId = 42_000, kMagic = 77;
const kKey = Buffer.alloc(32, 7);
const kSizes = {
  uint8_t: 1, int8_t: 1, uint16_t: 2, int16_t: 2, uint32_t: 4, int32_t: 4, float: 4,
};
const kSignature = MavLinkPacketSignature.SIGNATURE_LENGTH, kChecksum = 2;
const kHeader = MavLinkProtocolV2.PAYLOAD_OFFSET;
const { fields, frames } = JSON.parse(readFileSync(process.argv[2], "utf8"));

// The narrowest type; its largest number stays free for "not known".
function narrowest(low, high) {
  for (const bits of [8, 16, 32]) {
    if (low >= 0 && high < 2 ** bits - 1) return `uint${bits}_t`;
    if (low < 0 && low >= -(2 ** (bits - 1)) && high < 2 ** (bits - 1) - 1) return `int${bits}_t`;
  }
  throw new Error(`no type holds ${low} to ${high}`);
}

function scaled(field, step, offset) {
  const whole = (value) => Math.round((value - offset) / step);
  return { type: narrowest(whole(field.min), whole(field.max)), raw: whole };
}

const kForms = {
  decimal: (field) => scaled(field, 10 ** Math.floor(Math.log10(field.resolution) + 1e-9), 0),
  squeezed: (field) => scaled(field, field.resolution, field.min),
  float: (field) => {
    if (field.kind === "real") return { type: "float", raw: Math.fround };
    return scaled(field, 1, 0);
  },
};

// A message class as the generator of a dialect would write it.
function message(id, members) {
  const Message = class extends MavLinkData {};
  const ordered = [...members].sort((a, b) => kSizes[b.type] - kSizes[a.type]);
  let offset = 0;
  Message.MSG_ID = id;
  Message.MSG_NAME = `VEHICLE_STATE_${id}`;
  Message.MAGIC_NUMBER = kMagic;
  Message.FIELDS = ordered.map(({ name, type }) => {
    const field = new MavLinkPacketField(name, offset, false, kSizes[type], type);
    offset += kSizes[type];
    return field;
  });
  Message.PAYLOAD_LENGTH = offset;
  return Message;
}

function dialect(form) {
  const members = fields.map((field, i) => ({ name: `f${i}`, ...form(field) }));
  const groups = [members.slice(0, kPerMessage), members.slice(kPerMessage)];
  return groups.map((group, i) => ({
    group,
    first: i * kPerMessage,
    Message: message(kFirstId + i, group),
  }));
}

const protocol = new MavLinkProtocolV2(1, 1, MavLinkProtocolV2.IFLAG_SIGNED);

function write(parts, frame, sequence, now) {
  return Buffer.concat(parts.map(({ group, first, Message }, i) => {
    const data = new Message();
    group.forEach(({ name, raw }, k) => { data[name] = raw(frame[first + k]); });
    return protocol.sign(protocol.serialize(data, (2 * sequence + i) % 256), 1, kKey, now);
  }));
}

function read(parts, datagram) {
  let at = 0;
  return parts.map(({ Message }) => {
    const end = at + kHeader + datagram[at + 1] + kChecksum + kSignature;
    const packet = datagram.subarray(at, end);
    at = end;
    const checked = packet.subarray(0, packet.length - kSignature);
    const crc = mappings.x25crc(checked, 1, kChecksum, Message.MAGIC_NUMBER);
    if (crc !== protocol.crc(packet)) throw new Error("checksum");
    if (!new MavLinkPacketSignature(packet).matches(kKey)) throw new Error("signature");
    return protocol.data(protocol.payload(packet), Message);
  });
}

function check(parts, frame, datagram) {
  read(parts, datagram).forEach((data, i) => {
    const { group, first } = parts[i];
    const raws = group.map(({ name, raw }, k) => [name, raw(frame[first + k])]);
    const wanted = Object.fromEntries(raws);
    const got = Object.fromEntries(group.map(({ name }) => [name, data[name]]));
    // Negative zero is zero.
    for (const name in wanted) wanted[name] += 0;
    if (!isDeepStrictEqual(wanted, got)) throw new Error("the values that were read differ");
  });
}

function nanoseconds_each(work) {
  let best = Infinity;
  for (let round = 0; round < 5; ++round) {
    const begun = performance.now();
    frames.forEach(work);
    best = Math.min(best, ((performance.now() - begun) * 1e6) / frames.length);
  }
  return best;
}

const mean = (numbers) => numbers.reduce((a, b) => a + b, 0) / numbers.length;

const result = {};
for (const [name, form] of Object.entries(kForms)) {
  const parts = dialect(form), now = Date.UTC(2026, 0, 1);
  const datagrams = frames.map((frame, i) => write(parts, frame, i, now));
  datagrams.forEach((datagram, i) => check(parts, frames[i], datagram));
  const overhead = 2 * (kHeader + kChecksum + kSignature);
  const datagram = mean(datagrams.map((d) => d.length));
  result[name] = {
    payload: datagram - overhead,
    datagram,
    largest: parts.reduce((sum, { Message }) => sum + Message.PAYLOAD_LENGTH, overhead),
    encode_ns: nanoseconds_each((frame, i) => write(parts, frame, i, now)),
    decode_ns: nanoseconds_each((_, i) => read(parts, datagrams[i])),
  };
}
console.log(JSON.stringify(result));
