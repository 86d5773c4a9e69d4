// libFuzzer: any bytes as a message of a trainer. Build with the preset `fuzz`, run as
//   trainer_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/trainer
#include "findings.h"
#include "trainer_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nonet::fuzz::demand(nonet::fuzz::checkTrainer(nonet::fuzz::textOf(data, size)));
  return 0;
}
