// Names of teams, as they go over the wire and into names of files.
#pragma once

#include <string>

namespace nonet::app {

/// Throws std::runtime_error that says which letter does not do: a blank, a bracket, a quote or a semicolon
/// would end the name in an S-expression, a slash begins another folder.
void checkTeamName(const std::string& name);

}  // namespace nonet::app
