// Text <-> Percept. Grammar: server facts 1.5-1.7.
#pragma once

#include <string>
#include <string_view>

#include "nonet/protocol/percept.h"

namespace nonet::protocol {

/// Reads one sense message. Never throws and never fails as a whole: what is malformed or unknown is skipped
/// and counted in percept.unknownTokens. `percept` is cleared first.
void parsePercept(std::string_view text, Percept& percept);

/// Replaces `text` by the message in the server's format (fixed, two decimals). parse then write gives the
/// same bytes.
void writePercept(const Percept& percept, std::string& text);

}  // namespace nonet::protocol
