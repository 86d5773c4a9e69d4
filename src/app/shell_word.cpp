#include "nonet/app/shell_word.h"

namespace nonet::app {

std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char letter : text) safe += letter == '\'' ? std::string(R"('\'')") : std::string(1, letter);
  return safe + "'";
}

std::string shellWord(const std::string& text) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
  const bool plain = !text.empty() && text.find_first_not_of(kPlain) == std::string::npos;
  return plain ? text : quoted(text);
}

}  // namespace nonet::app
