// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/gzip.hpp"

#include <zlib.h>

#include <algorithm>

namespace pitwall::replay {
namespace {

constexpr int kZlibWindow = 15, kGzipWindow = 15 + 16;
constexpr std::size_t kFirstStep = 1U << 16U;

// One stream of zlib's; appends to out.bytes.
class Inflater {
 public:
  Inflater(std::string_view packed, int window) : packed_(packed) {
    is_open_ = inflateInit2(&stream_, window) == Z_OK;
  }
  ~Inflater() {
    if (is_open_) inflateEnd(&stream_);
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  void run(Unpacked& out, std::size_t most) {
    if (!is_open_) return void(out.problem = "there is no memory to unpack it");
    // zlib does not write to its input.
    stream_.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed_.data()));
    int result = Z_OK;
    while (result == Z_OK) result = step(out, most);
    out.at += stream_.total_in;
    if (result == Z_STREAM_END) return;
    out.is_cut = result == Z_BUF_ERROR && stream_.total_in == packed_.size();
    if (out.is_cut)
      out.problem = "the packed data is cut off";
    else if (out.bytes.size() >= most)
      out.problem = "there is more in it than may be unpacked at once: unpack it to a file first";
    else
      out.problem = "the packed data is damaged";
  }

 private:
  int step(Unpacked& out, std::size_t most) {
    const std::size_t before = out.bytes.size();
    if (before >= most) return Z_MEM_ERROR;
    // zlib counts its input in 32 bits.
    stream_.avail_in =
        static_cast<uInt>(std::min<std::size_t>(packed_.size() - stream_.total_in, UINT32_MAX));
    const std::size_t room = std::min(std::max(before, kFirstStep), most - before);
    out.bytes.resize(before + room);
    stream_.next_out = reinterpret_cast<Bytef*>(out.bytes.data() + before);
    stream_.avail_out = static_cast<uInt>(room);
    const int result = inflate(&stream_, Z_NO_FLUSH);
    out.bytes.resize(before + room - stream_.avail_out);
    return result;
  }

  std::string_view packed_;
  z_stream stream_{};
  bool is_open_ = false;
};

}  // namespace

Unpacked unpack_gzip(std::string_view packed, std::size_t most) {
  Unpacked out;
  while (out.problem.empty() && out.at < packed.size()) {
    const std::string_view rest = packed.substr(out.at);
    if (out.at > 0 && rest.find_first_not_of('\0') == std::string_view::npos) break;
    Inflater(rest, kGzipWindow).run(out, most);
  }
  return out;
}

Unpacked unpack_zlib(std::string_view packed, std::size_t most) {
  Unpacked out;
  Inflater(packed, kZlibWindow).run(out, most);
  return out;
}

}  // namespace pitwall::replay
