// Sizes of the vehicle state as signed MAVLink 2, written by node-mavlink.
//   in     argument: a JSON file {"fields": [{name, kind, min, max, resolution}],
//          "frames": [[value]]}
//   out    standard output: JSON, for each form {payload, datagram}; bytes, means over the trace,
//          `datagram` without IP and UDP. No times: JavaScript's say nothing of MAVLink's C code
//   invariants  every message with its header, checksum and signature; fields in the order of
//          MAVLink, widest first; zeros at a payload's end are not sent. Every datagram is read
//          again and its values compared
//   forms  decimal: whole numbers of a power of ten of the unit, as the dialects of MAVLink have
//          them (cm, dV, ...), not coarser than our resolution, in the narrowest type
//          squeezed: our own steps and offsets, in the narrowest type; no dialect does so
//          float: each number a float, each label and flag an uint8_t, bits an uint32_t
//          Of two messages (50 fields each: MAVLink allows 64) in one datagram; and, where the 255
//          bytes of a payload hold it, of one message with an array of each type: 25 bytes less,
//          but its fields have no names and units any more
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { isDeepStrictEqual } from "node:util";
import mappings from "mavlink-mappings";
import mavlink from "node-mavlink";

const { MavLinkData, MavLinkPacketField } = mappings;
const { DESERIALIZERS, MavLinkPacketSignature, MavLinkProtocolV2 } = mavlink;

const kPerMessage = 50, kLargestPayload = 255, kFirstId = 42_000, kMagic = 77;
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

// A message class as the generator of a dialect would write it. Members: {name, type, count},
// count 0 for a field that is no array.
function message(id, members) {
  const Message = class extends MavLinkData {};
  const ordered = [...members].sort((a, b) => kSizes[b.type] - kSizes[a.type]);
  let offset = 0;
  Message.MSG_ID = id;
  Message.MSG_NAME = `VEHICLE_STATE_${id}`;
  Message.MAGIC_NUMBER = kMagic;
  Message.FIELDS = ordered.map(({ name, type, count }) => {
    const whole = count > 0 ? `${type}[]` : type;
    const field = new MavLinkPacketField(name, offset, false, kSizes[type], whole, count);
    offset += kSizes[type] * Math.max(1, count);
    return field;
  });
  Message.PAYLOAD_LENGTH = offset;
  return Message;
}

// Parts of a datagram: a message, and its values by member from those of a frame.
function two_messages(encoded) {
  return [encoded.slice(0, kPerMessage), encoded.slice(kPerMessage)].map((group, i) => ({
    Message: message(kFirstId + i, group.map(({ name, type }) => ({ name, type, count: 0 }))),
    values: (frame) => Object.fromEntries(group.map((f) => [f.name, f.raw(frame[f.at])])),
  }));
}

function one_message(encoded) {
  const types = Object.groupBy(encoded, ({ type }) => type);
  const arrays = Object.entries(types).map(([type, group]) => ({
    name: `all_${type}`, type, count: group.length, group,
  }));
  return [{
    Message: message(kFirstId, arrays),
    values: (frame) => Object.fromEntries(
      arrays.map(({ name, group }) => [name, group.map((f) => f.raw(frame[f.at]))])),
  }];
}

const protocol = new MavLinkProtocolV2(1, 1, MavLinkProtocolV2.IFLAG_SIGNED);

function write(parts, frame, sequence, now) {
  return Buffer.concat(parts.map(({ Message, values }, i) => {
    const data = Object.assign(new Message(), values(frame));
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

// Negative zero is zero.
const plain = (value) => (Array.isArray(value) ? value.map((v) => v + 0) : value + 0);

function check(parts, frame, datagram) {
  read(parts, datagram).forEach((data, i) => {
    for (const [name, value] of Object.entries(parts[i].values(frame))) {
      if (!isDeepStrictEqual(plain(value), data[name])) {
        throw new Error(`${parts[i].Message.MSG_NAME}.${name} is read as ${data[name]}`);
      }
    }
  });
}

function sizes_of(parts) {
  const now = Date.UTC(2026, 0, 1);
  let bytes = 0;
  frames.forEach((frame, i) => {
    const datagram = write(parts, frame, i, now);
    check(parts, frame, datagram);
    bytes += datagram.length;
  });
  const datagram = bytes / frames.length;
  return { payload: datagram - parts.length * (kHeader + kChecksum + kSignature), datagram };
}

const result = {};
for (const [name, form] of Object.entries(kForms)) {
  const encoded = fields.map((field, at) => ({ name: `f${at}`, at, ...form(field) }));
  result[name] = sizes_of(two_messages(encoded));
  const one = one_message(encoded);
  if (one[0].Message.PAYLOAD_LENGTH > kLargestPayload) continue;
  result[`${name}, one message`] = sizes_of(one);
}
console.log(JSON.stringify(result));
