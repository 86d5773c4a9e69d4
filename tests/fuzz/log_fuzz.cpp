// libFuzzer: any bytes as a log file. Build with the preset `fuzz`, run as
//   log_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/log
#include "findings.h"
#include "log_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nonet::fuzz::demand(nonet::fuzz::checkLog(nonet::fuzz::textOf(data, size)));
  return 0;
}
