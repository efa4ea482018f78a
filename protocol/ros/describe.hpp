// Type description of a message for programs that were compiled without it: its fields and those of
// every nested message, as rosidl describes them; from these the .msg text and the type hash.
//   in     a message (protocol/ros/message.hpp), or fields listed at run time
//   out    TypeDescription; text of encoding `ros2msg`; hash "RIHS01_" and 64 hexadecimal digits
//   invariants
//          the hash depends only on names, types and order of the fields: constants and comments
//          are part of the text only
//   source ros2/rosidl: type_description_interfaces, rosidl_generator_type_description (RIHS01);
//          MCAP and Foxglove: schema encoding "ros2msg"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "protocol/ros/message.hpp"

namespace pitwall::ros {

// FieldType of type_description_interfaces, restricted to the types of our .msg files.
enum class TypeId : std::uint8_t {
  kNested = 1,
  kInt8 = 2,
  kUint8 = 3,
  kInt16 = 4,
  kUint16 = 5,
  kInt32 = 6,
  kUint32 = 7,
  kInt64 = 8,
  kUint64 = 9,
  kFloat = 10,
  kDouble = 11,
  kBool = 15,
  kByte = 16,
  kString = 17,
  kBoundedString = 21
};

enum class Many : std::uint8_t { kOne = 0, kFixed = 48, kAny = 144 };

struct FieldDescription {
  std::string name;
  TypeId type = TypeId::kNested;
  Many many = Many::kOne;
  std::uint64_t count = 0;  // of a fixed array
  std::string nested{};     // "std_msgs/msg/Header"; empty unless kNested
  std::size_t bound = 0;    // of a bounded string
  std::string comment{};    // after the field in the text, one line
};

struct StructDescription {
  std::string name;  // "nav_msgs/msg/Odometry"
  std::vector<FieldDescription> fields;
  std::vector<Constant> constants;
};

struct TypeDescription {
  StructDescription type;
  std::map<std::string, StructDescription> referenced;  // by name, in the order of the hash
};

template <class T>
constexpr TypeId type_id_of() {
  if constexpr (std::is_same_v<T, bool>) return TypeId::kBool;
  if constexpr (std::is_same_v<T, Byte>) return TypeId::kByte;
  if constexpr (std::is_same_v<T, std::int8_t>) return TypeId::kInt8;
  if constexpr (std::is_same_v<T, std::uint8_t>) return TypeId::kUint8;
  if constexpr (std::is_same_v<T, std::int16_t>) return TypeId::kInt16;
  if constexpr (std::is_same_v<T, std::uint16_t>) return TypeId::kUint16;
  if constexpr (std::is_same_v<T, std::int32_t>) return TypeId::kInt32;
  if constexpr (std::is_same_v<T, std::uint32_t>) return TypeId::kUint32;
  if constexpr (std::is_same_v<T, std::int64_t>) return TypeId::kInt64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return TypeId::kUint64;
  if constexpr (std::is_same_v<T, float>) return TypeId::kFloat;
  if constexpr (std::is_same_v<T, double>) return TypeId::kDouble;
  if constexpr (std::is_same_v<T, std::string>) return TypeId::kString;
  if constexpr (BoundedText<T>) return TypeId::kBoundedString;
  return TypeId::kNested;
}

template <Message M>
void describe_into(TypeDescription& all, StructDescription& out);

template <class T>
void describe_field(TypeDescription& all, FieldDescription& out) {
  if constexpr (Sequence<T>) {
    out.many = Many::kAny;
    describe_field<typename T::value_type>(all, out);
  } else if constexpr (FixedArray<T>) {
    out.many = Many::kFixed;
    out.count = std::tuple_size_v<T>;
    describe_field<typename T::value_type>(all, out);
  } else {
    out.type = type_id_of<T>();
    if constexpr (BoundedText<T>) out.bound = T::kBound;
    if constexpr (Message<T>) {
      out.nested = T::kType;
      const auto [known, added] = all.referenced.try_emplace(out.nested);
      if (added) describe_into<T>(all, known->second);
    } else {
      static_assert(type_id_of<T>() != TypeId::kNested, "no field of a .msg");
    }
  }
}

template <Message M>
void describe_into(TypeDescription& all, StructDescription& out) {
  out.name = M::kType;
  if constexpr (HasConstants<M>)
    for (const Constant& constant : M::kConstants) out.constants.push_back(constant);
  for_each_field<M>([&]<class T>(const Field<M, T>& field) {
    FieldDescription described;
    described.name = field.name;
    describe_field<T>(all, described);
    out.fields.push_back(std::move(described));
  });
}

template <Message M>
TypeDescription describe() {
  TypeDescription all;
  describe_into<M>(all, all.type);
  return all;
}

// Text of the .msg file of one message alone.
std::string file_text(const StructDescription& type);
// Text as `ros2msg`: the .msg file, followed by those of all nested messages.
std::string message_text(const TypeDescription& type);
std::string type_hash(const TypeDescription& type);

}  // namespace pitwall::ros
