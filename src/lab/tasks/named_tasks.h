// Tasks that exist once for every name of something else, a kick say.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "nonet/lab/tasks/task.h"

namespace nonet::lab {

/// T(name), made when it is first asked for; it stays.
template <class T>
const Task& taskNamed(std::string_view name) {
  static std::mutex mutex;
  static std::map<std::string, T, std::less<>> tasks;
  const std::lock_guard lock(mutex);
  const auto found = tasks.find(name);
  if (found != tasks.end()) return found->second;
  return tasks.try_emplace(std::string(name), std::string(name)).first->second;
}

}  // namespace nonet::lab
