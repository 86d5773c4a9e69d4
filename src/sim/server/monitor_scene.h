// What never changes in the scene that monitors get (server facts 5.2).
#pragma once

#include <string>
#include <string_view>

#include "nonet/sim/settings/settings.h"

namespace nonet::sim {

/// The transform of a node that stands where its parent stands.
inline constexpr std::string_view kIdentity = "(SLT 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1)";

/// Lights, field, sky, goals, walls, flags and lines as they are in a full scene.
std::string staticScene(const Settings& settings);

/// The same in a difference; the first one repeats the visibility of every mesh.
std::string staticDifference(bool visibility);

}  // namespace nonet::sim
