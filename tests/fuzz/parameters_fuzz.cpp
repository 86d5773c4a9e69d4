// libFuzzer: any bytes as a parameter file, its first line also as an assignment. Build with the preset
// `fuzz`, run as
//   parameters_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/parameters
#include "findings.h"
#include "parameter_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nonet::fuzz::demand(nonet::fuzz::checkParameterText(nonet::fuzz::textOf(data, size)));
  return 0;
}
