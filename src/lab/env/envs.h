// The environments, for their list (env.cpp).
#pragma once

#include "nonet/lab/env/env.h"

namespace nonet::lab {

std::unique_ptr<Env> makeDribbleEnv(const EnvSettings& settings);
std::unique_ptr<Env> makeReceiveEnv(const EnvSettings& settings);
std::unique_ptr<Env> makeRunEnv(const EnvSettings& settings);

}  // namespace nonet::lab
