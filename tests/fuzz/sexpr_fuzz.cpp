// libFuzzer: any bytes as an agent's message, as a text for the bare reader in both dialects, and as a stream
// of frames. Build with the preset `fuzz`, run as
//   sexpr_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/effectors
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "nonet/protocol/framing.h"

#include "../protocol/round_trip_properties.h"

namespace {

using namespace nonet::protocol;

void require(const std::string& problem) {
  if (!problem.empty()) {
    std::fprintf(stderr, "%s\n", problem.c_str());
    std::abort();
  }
}

// The bytes, cut in two anywhere, give the same messages as in one piece.
std::string checkFrames(std::string_view bytes) {
  constexpr std::size_t kLimit = 300;
  FrameReader whole(kLimit);
  FrameReader cut(kLimit);
  const std::size_t middle = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0]) % bytes.size();
  whole.append(bytes);
  cut.append(bytes.substr(0, middle));
  std::string fromCut;
  std::string fromWhole;
  while (const auto message = cut.next()) appendFrame(fromCut, *message);
  cut.append(bytes.substr(middle));
  while (const auto message = cut.next()) appendFrame(fromCut, *message);
  while (const auto message = whole.next()) appendFrame(fromWhole, *message);
  return fromCut == fromWhole && cut.failed() == whole.failed() ? "" : "fragments differ";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  require(checkEffectors(bytes));
  require(checkReader<SexprDialect::Plain>(bytes));
  require(checkReader<SexprDialect::Commands>(bytes));
  require(checkFrames(bytes));
  return 0;
}
