// A short text kept inside the object: copies and comparisons without allocation. Longer text is cut.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace nonet {

template <std::size_t Capacity>
class InlineString {
 public:
  InlineString() = default;
  InlineString(std::string_view text) { assign(text); }  // NOLINT: implicit on purpose

  /// Keeps the first Capacity characters; false if something was cut.
  bool assign(std::string_view text) {
    size_ = std::min(text.size(), Capacity);
    std::copy_n(text.data(), size_, data_.data());
    return size_ == text.size();
  }
  void clear() { size_ = 0; }
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  std::string_view view() const { return {data_.data(), size_}; }
  operator std::string_view() const { return view(); }  // NOLINT: implicit on purpose
  friend bool operator==(const InlineString& a, const InlineString& b) { return a.view() == b.view(); }
  friend bool operator==(const InlineString& a, std::string_view b) { return a.view() == b; }

 private:
  std::array<char, Capacity> data_{};
  std::size_t size_ = 0;
};

}  // namespace nonet
