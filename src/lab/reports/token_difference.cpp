#include "nonet/lab/reports/token_difference.h"

#include <algorithm>

namespace nonet::lab {
namespace {

// Gives one bracket or atom after the other.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) {}

  /// Empty at the end.
  std::string_view next() {
    begin_ = text_.find_first_not_of(" \t\r\n", end_);
    if (begin_ == std::string_view::npos) begin_ = text_.size();
    end_ = begin_;
    if (end_ < text_.size() && (text_[end_] == '(' || text_[end_] == ')')) {
      ++end_;
    } else {
      end_ = std::min(text_.find_first_of(" \t\r\n()", end_), text_.size());
    }
    return text_.substr(begin_, end_ - begin_);
  }

  /// The innermost list around the token given last.
  std::string surroundings() const {
    if (begin_ == text_.size()) return "nothing";
    std::size_t open = begin_;
    int depth = text_[begin_] == '(' ? 1 : 0;  // a bracket that opens is shown with its own list
    while (depth < 1 && open > 0) {
      --open;
      depth += text_[open] == '(' ? 1 : text_[open] == ')' ? -1 : 0;
    }
    if (depth < 1) return std::string(text_.substr(begin_, end_ - begin_));
    std::size_t close = open;
    do {
      depth += close == open ? 0 : text_[close] == '(' ? 1 : text_[close] == ')' ? -1 : 0;
      ++close;
    } while (depth > 0 && close < text_.size());
    constexpr std::size_t kLongest = 80;  // characters: a whole vision message says nothing
    std::string list(text_.substr(open, close - open));
    if (list.size() > kLongest) list = std::string(text_.substr(begin_, kLongest)) + " ...";
    return list;
  }

 private:
  std::string_view text_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace

std::optional<TokenDifference> firstTokenDifference(std::string_view first, std::string_view second) {
  Tokens a(first);
  Tokens b(second);
  for (std::size_t token = 1;; ++token) {
    const std::string_view x = a.next();
    const std::string_view y = b.next();
    if (x != y) return TokenDifference{token, a.surroundings(), b.surroundings()};
    if (x.empty()) return std::nullopt;
  }
}

}  // namespace nonet::lab
