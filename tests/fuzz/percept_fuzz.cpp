// libFuzzer: any bytes as a sense message. Build with the preset `fuzz`, run as
//   percept_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/percept
#include "../protocol/round_trip_properties.h"
#include "findings.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nonet::fuzz::demand(nonet::protocol::checkPercept(nonet::fuzz::textOf(data, size)));
  return 0;
}
