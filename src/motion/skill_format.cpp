#include <fmt/format.h>

#include "nonet/motion/skill_language.h"

#include "skill_lexer.h"

namespace nonet::motion {

namespace {

using Kind = SkillToken::Kind;

bool isSymbol(const SkillToken& token, std::string_view text) {
  return token.kind == Kind::Symbol && token.text == text;
}

// A minus sign belongs to its number unless something stands before it that it could be subtracted from.
bool isSign(const std::vector<SkillToken>& line, std::size_t i) {
  if (!isSymbol(line[i], "-")) return false;
  if (i == 0) return true;
  const SkillToken& before = line[i - 1];
  if (before.kind == Kind::Number || isSymbol(before, ")")) return false;
  if (before.kind != Kind::Word) return true;
  // "left.knee -30deg": the word is the name of a joint. "over a - b": it is a parameter.
  const bool joint = i >= 2 && isSymbol(line[i - 2], ".");
  const bool keyword = before.text == "over" || before.text == "at" || before.text == "wait" ||
                       before.text == "in" || before.text == "within" || before.text == "after" ||
                       before.text == "stiffness" || before.text == "repeat" || before.text == "direction";
  return joint || keyword;
}

bool spaceBefore(const std::vector<SkillToken>& line, std::size_t i) {
  if (i == 0) return false;
  const SkillToken& token = line[i];
  const SkillToken& before = line[i - 1];
  if (token.kind == Kind::Comment) return true;
  if (isSymbol(token, ",") || isSymbol(token, ")") || isSymbol(token, ".") || isSymbol(token, ".."))
    return false;
  if (isSymbol(before, "(") || isSymbol(before, ".") || isSymbol(before, "..")) return false;
  return !isSign(line, i - 1);
}

std::string formatLine(const std::vector<SkillToken>& line, int indent) {
  std::string text(static_cast<std::size_t>(2 * indent), ' ');
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (spaceBefore(line, i)) text += line[i].kind == Kind::Comment ? "  " : " ";
    text += line[i].text;
  }
  return text + "\n";
}

}  // namespace

std::string formatSkills(std::string_view text, const std::string& file,
                         const std::vector<SkillText>& others) {
  parseSkills(text, file, nullptr, others);
  std::string result;
  std::vector<SkillToken> line;
  int indent = 0;
  bool blank = false;  // an empty line waits to be written
  const auto finishLine = [&] {
    if (line.empty()) {
      blank = !result.empty();
      return;
    }
    int closing = 0;  // brackets with which the line begins
    while (static_cast<std::size_t>(closing) < line.size() &&
           isSymbol(line[static_cast<std::size_t>(closing)], "}")) {
      ++closing;
    }
    int depth = 0;
    for (const SkillToken& token : line) depth += isSymbol(token, "{") ? 1 : isSymbol(token, "}") ? -1 : 0;
    if (blank) result += "\n";
    blank = false;
    result += formatLine(line, std::max(0, indent - closing));
    indent = std::max(0, indent + depth);
    line.clear();
  };
  for (const SkillToken& token : lexSkills(text, file)) {
    if (token.kind == Kind::NewLine) {
      finishLine();
    } else if (token.kind != Kind::End) {
      line.push_back(token);
    }
  }
  if (!line.empty()) finishLine();
  return result;
}

}  // namespace nonet::motion
