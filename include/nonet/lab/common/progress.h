// How far a long measurement is.
#pragma once

#include <functional>
#include <string>

namespace nonet::lab {

/// Told after each trial what is measured and how many trials of how many are done: from any thread, one at a
/// time.
using TrialProgress = std::function<void(const std::string& what, int done, int all)>;

}  // namespace nonet::lab
