// Appends numbers to a string without allocating once the string has grown.
#pragma once

#include <string>
#include <string_view>

namespace nonet::protocol {

/// As printf("%.2f"), the format of every real number in a sense message.
void appendTwoDecimals(std::string& text, double value);
/// As printf("%.6g"), the format of the numbers that we send.
void appendSixDigits(std::string& text, double value);
void appendInteger(std::string& text, int value);

}  // namespace nonet::protocol
