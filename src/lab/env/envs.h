// The environments, for their list (env.cpp).
#pragma once

#include "nonet/lab/env/env.h"

namespace nonet::lab {

std::unique_ptr<Env> makeDribbleEnv(const EnvSetup& setup);
std::unique_ptr<Env> makeReceiveEnv(const EnvSetup& setup);
std::unique_ptr<Env> makeRunEnv(const EnvSetup& setup);

}  // namespace nonet::lab
