// libFuzzer: any bytes as messages of the monitor stream, one per line. Build with the preset `fuzz`, run as
//   monitor_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/monitor
#include "findings.h"
#include "monitor_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nonet::fuzz::demand(nonet::fuzz::checkMonitorStream(nonet::fuzz::textOf(data, size)));
  return 0;
}
