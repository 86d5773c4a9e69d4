// The decision trace: what an agent believed and wanted in one cycle. The agent is a function of its
// percepts, so a trace can be made afterwards from any log.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "nonet/agent/agent.h"

namespace nonet::agent {

/// One cycle. Metres, seconds, degrees; places as [x, y] in the own team's field frame, poses as [x, y,
/// heading]. `side` tells which way that frame lies: 1 as the world (the own goal on the left), -1 turned by
/// half a turn.
nlohmann::ordered_json traceOf(const Agent& agent);

/// The columns of traceCsv(), and one cycle of traceOf() as such a line; what is not known is empty.
std::string_view traceCsvHeader();
std::string traceCsv(const nlohmann::ordered_json& trace);

/// One cycle of traceOf() in sentences.
std::string traceText(const nlohmann::ordered_json& trace);

}  // namespace nonet::agent
