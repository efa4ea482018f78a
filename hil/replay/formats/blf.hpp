// Reader of Vector BLF logs: a file header, containers of objects compressed by zlib, objects.
//
//   LOGG | size | application.. | file size, unpacked size, objects | start, end | padding
//   LOBJ | header size, version | object size | type | 10: method, unpacked size, packed objects
//   LOBJ | header size, version | object size | type | flags, stamp | 1: channel, flags, length..
//
//   in     the whole file
//   out    CanLog of CAN_MESSAGE 1, CAN_MESSAGE2 86, CAN_FD_MESSAGE 100, CAN_FD_MESSAGE_64 101;
//          CAN_ERROR 2, CAN_ERROR_EXT 73 and CAN_FD_ERROR_64 104 are counted as error frames, all
//          other types as other records. Channel 1 is can0. An object may span two containers. The
//          start is local time of the recorder; it is taken as UTC, with a note. Stamps are signed:
//          a record before the trigger is earlier than the start
//   errors unreadable objects are left out; of a damaged or cut container everything before the
//          damage is read; places are those of the container in the file
//   source python-can can/io/blf.py, T. Lorenz' Vector_BLF
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

Result<CanLog, Problem> read_blf(std::string_view bytes, std::string_view file_name,
                                 const LogWatch& watch = {});

}  // namespace pitwall::replay
