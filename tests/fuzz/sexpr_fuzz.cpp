// libFuzzer: any bytes as an agent's message, and as a text for the bare reader in both dialects. Build with
// the preset `fuzz`, run as
//   sexpr_fuzz -max_total_time=60 NEW_CORPUS tests/fuzz/corpus/sexpr
#include "../protocol/round_trip_properties.h"
#include "findings.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nonet::protocol;
  const std::string_view bytes = nonet::fuzz::textOf(data, size);
  nonet::fuzz::demand(checkEffectors(bytes));
  nonet::fuzz::demand(checkReader<SexprDialect::Plain>(bytes));
  nonet::fuzz::demand(checkReader<SexprDialect::Commands>(bytes));
  return 0;
}
