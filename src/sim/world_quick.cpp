#include "sim/world_quick.h"
namespace nonet::sim {
void stepQuickly(Cluster& cluster, dReal seconds) {
  stepExactly(cluster, seconds);
}
}  // namespace nonet::sim
