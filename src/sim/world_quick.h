#pragma once
#include "sim/world_islands.h"
namespace nonet::sim {
void stepQuickly(Cluster& cluster, dReal seconds);
}
