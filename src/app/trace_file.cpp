#include "nonet/app/trace_file.h"

#include "nonet/agent/trace.h"

namespace nonet::app {

void TraceFile::add(const agent::Agent& agent) {
  constexpr int kFlushInterval = 250;  // cycles: a killed agent loses five seconds at most
  file_.write(agent::traceOf(agent).dump() + "\n");
  if (++sinceFlush_ < kFlushInterval) return;
  sinceFlush_ = 0;
  file_.flush();
}

}  // namespace nonet::app
