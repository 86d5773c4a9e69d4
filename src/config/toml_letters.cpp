#include "nonet/config/toml_letters.h"

namespace nonet::config {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kEndOfValue = " \t\r\n\v\f,";  // where toml++ stops to read what is no value
constexpr std::string_view kBegins = "[{";

bool isOneOf(std::string_view letters, char c) {
  return letters.find(c) != std::string_view::npos;
}

// Where the next byte stands.
class Place {
 public:
  bool mayBeForeign() const { return !doubtful_ && (comment_ || (quote_ != 0 && !threefold_)); }

  // Reads what begins the text, as long as it belongs together: an escape or three quotes. Its length.
  std::size_t read(std::string_view text) {
    const std::size_t length = lengthOf(text);
    if (quote_ == 0 && !comment_) follow(text.front());
    return length;
  }

 private:
  std::size_t lengthOf(std::string_view text) {
    const char c = text.front();
    if (c == '\n') {
      comment_ = false;
      doubtful_ = false;
      if (!threefold_) quote_ = 0;
    } else if (comment_) {
      return 1;
    } else if (quote_ == 0) {
      return open(text);
    } else if (c == '\\' && quote_ == '"' && text.size() > 1 && text[1] != '\n') {
      return 2;
    } else if (c == quote_) {
      return close(text);
    }
    return 1;
  }

  static bool isThreefold(std::string_view text) {
    return text.size() >= 3 && text[1] == text[0] && text[2] == text[0];
  }

  std::size_t open(std::string_view text) {
    comment_ = text.front() == '#';
    if (text.front() != '"' && text.front() != '\'') return 1;
    // Of a key behind a dot (a."x"), or a mistake (2"x", 2="x") where toml++ reads on without heeding quotes.
    doubtful_ = doubtful_ || !mayBegin_;
    quote_ = text.front();
    threefold_ = isThreefold(text);
    return threefold_ ? 3 : 1;
  }

  // Whether a text may begin behind this letter, which stands outside of texts and comments.
  void follow(char c) {
    if (c == '[') ++arrays_;
    if (c == ']' && arrays_ > 0) --arrays_;
    if (c == '\n') onlyKey_ = arrays_ == 0;
    const bool ends = isOneOf(kEndOfValue, c);
    const bool assigns = c == '=' && onlyKey_;
    mayBegin_ = ends || assigns || (mayBegin_ && isOneOf(kBegins, c));
    if (c == ',' || c == '=' || isOneOf(kBegins, c)) onlyKey_ = false;
  }

  std::size_t close(std::string_view text) {
    if (threefold_ && !isThreefold(text)) return 1;
    const std::size_t length = threefold_ ? 3 : 1;
    quote_ = 0;
    threefold_ = false;
    return length;
  }

  bool comment_ = false;
  char quote_ = 0;  // 0: outside of texts
  bool threefold_ = false;
  bool doubtful_ = false;  // until the line ends
  bool mayBegin_ = true;   // a text
  bool onlyKey_ = true;    // so far in this line
  int arrays_ = 0;         // that are open, or a table's brackets
};

}  // namespace

std::size_t lineOfForeignLetter(std::string_view toml) {
  if (toml.substr(0, kByteOrderMark.size()) == kByteOrderMark) toml.remove_prefix(kByteOrderMark.size());
  Place place;
  std::size_t line = 1;
  while (!toml.empty()) {
    const bool foreign = static_cast<unsigned char>(toml.front()) >= 0x80;
    if (foreign && !place.mayBeForeign()) return line;
    if (toml.front() == '\n') ++line;
    toml.remove_prefix(place.read(toml));
  }
  return 0;
}

}  // namespace nonet::config
