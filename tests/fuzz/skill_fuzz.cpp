// libFuzzer: any bytes as a skill file. Build with the preset `fuzz`, run as
//   skill_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/skill
#include "findings.h"
#include "skill_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nonet::fuzz::demand(nonet::fuzz::checkSkillText(nonet::fuzz::textOf(data, size)));
  return 0;
}
