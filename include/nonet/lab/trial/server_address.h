// Where a server listens that something is measured on, embedded or real.
#pragma once

#include <string>

namespace nonet::lab {

struct ServerAddress {
  std::string host = "127.0.0.1";
  int port = 3100;
  int monitorPort = 3200;
};

}  // namespace nonet::lab
