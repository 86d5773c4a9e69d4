// libFuzzer: any bytes as a sense message. Build with the preset `fuzz`, run as
//   percept_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/percept
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "../protocol/round_trip_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = nonet::protocol::checkPercept({reinterpret_cast<const char*>(data), size});
  if (!problem.empty()) {
    std::fprintf(stderr, "%s\n", problem.c_str());
    std::abort();
  }
  return 0;
}
