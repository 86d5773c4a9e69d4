#include "nonet/app/version.h"

#include "nonet_commit.h"

namespace nonet::app {

std::string versionText() {
  return "nonet " NONET_VERSION ", commit " NONET_COMMIT;
}

}  // namespace nonet::app
