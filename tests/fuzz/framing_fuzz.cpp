// libFuzzer: any bytes as a stream of frames that is cut anywhere. Build with the preset `fuzz`, run as
//   framing_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/framing
#include "findings.h"
#include "framing_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nonet::fuzz::demand(nonet::fuzz::checkFraming(nonet::fuzz::textOf(data, size)));
  return 0;
}
