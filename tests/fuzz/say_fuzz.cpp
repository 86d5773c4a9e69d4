// libFuzzer: any bytes as a say message that is heard, or as what a robot believes and says. Build with the
// preset `fuzz`, run as
//   say_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/say
#include "findings.h"
#include "say_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nonet::fuzz::demand(nonet::fuzz::checkSay(nonet::fuzz::textOf(data, size)));
  return 0;
}
