#include "skill_like.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nonet::motion {

namespace {

using Kind = SkillToken::Kind;
using Words = std::vector<SkillToken>;

bool is(const SkillToken& token, std::string_view text) {
  return (token.kind == Kind::Word || token.kind == Kind::Symbol) && token.text == text;
}

/// The last word is always Kind::End.
const SkillToken& wordAt(const Words& words, std::size_t at) {
  return words[std::min(at, words.size() - 1)];
}

/// "skill a like b {" begins here.
bool isLike(const Words& words, std::size_t at) {
  return is(wordAt(words, at), "skill") && wordAt(words, at + 1).kind == Kind::Word &&
         is(wordAt(words, at + 2), "like") && wordAt(words, at + 3).kind == Kind::Word &&
         is(wordAt(words, at + 4), "{");
}

/// "skill a {" begins here. No statement has words of this order.
bool isSkill(const Words& words, std::size_t at) {
  return isLike(words, at) || (is(wordAt(words, at), "skill") && wordAt(words, at + 1).kind == Kind::Word &&
                               is(wordAt(words, at + 2), "{"));
}

/// A skill taken apart; whether the parts make sense, the parser says.
struct Parts {
  struct Parameter {
    std::string_view name;
    Words words;  // "parameter x = 1m in 0m..2m", and behind it those that restate it
  };
  std::vector<Parameter> parameters;
  Words kick;
  Words statements;
  bool whole = true;  // otherwise an error was told, and there are neither statements nor a head
};

/// Reads the parts of one skill, from behind its opening bracket.
class PartReader {
 public:
  PartReader(const Words& words, std::size_t at) : words_(words), at_(at) {}

  Parts run() {
    Parts parts;
    while (is(peek(), "parameter")) parts.parameters.push_back(parameter());
    if (is(peek(), "kick")) {
      take(parts.kick);
      if (is(peek(), "{")) group(parts.kick, "{", "}");
    }
    return parts;
  }

  /// Up to the bracket that closes the skill, or the end of the file.
  void statements(Words& to) {
    int open = 1;
    while (peek().kind != Kind::End) {
      open += is(peek(), "{") ? 1 : is(peek(), "}") ? -1 : 0;
      if (open == 0) return;
      take(to);
    }
  }

  const SkillToken& peek() const { return wordAt(words_, at_); }
  std::size_t at() const { return at_; }

 private:
  void take(Words& to) {
    to.push_back(peek());
    ++at_;
  }

  Parts::Parameter parameter() {
    Parts::Parameter parameter;
    take(parameter.words);
    parameter.name = peek().text;
    if (peek().kind == Kind::Word) take(parameter.words);
    if (!is(peek(), "=")) return parameter;
    take(parameter.words);
    value(parameter.words);
    if (!is(peek(), "in")) return parameter;
    take(parameter.words);
    value(parameter.words);
    if (!is(peek(), "..")) return parameter;
    take(parameter.words);
    value(parameter.words);
    return parameter;
  }

  // Numbers, names and brackets with signs between them.
  void value(Words& to) {
    for (;;) {
      if (is(peek(), "-")) take(to);
      if (is(peek(), "(")) {
        group(to, "(", ")");
      } else if (peek().kind == Kind::Word || peek().kind == Kind::Number) {
        take(to);
      } else {
        return;
      }
      if (!is(peek(), "+") && !is(peek(), "-") && !is(peek(), "*") && !is(peek(), "/")) return;
      take(to);
    }
  }

  // From an opening bracket to the one that closes it; round ones do not reach past a curled one.
  void group(Words& to, std::string_view opening, std::string_view closing) {
    const bool round = opening == "(";
    int open = 0;
    while (peek().kind != Kind::End) {
      if (round && (is(peek(), "{") || is(peek(), "}"))) return;
      open += is(peek(), opening) ? 1 : is(peek(), closing) ? -1 : 0;
      take(to);
      if (open == 0) return;
    }
  }

  const Words& words_;
  std::size_t at_;
};

class Writer {
 public:
  Writer(const Words& words, const std::string& file, const std::vector<SkillText>& others,
         std::vector<std::string>* errors)
      : words_(words), file_(file), others_(others), otherWords_(others.size()), errors_(errors) {}

  Words run() {
    Words result;
    for (std::size_t at = 0; at < words_.size();) {
      if (isLike(words_, at)) {
        write(at, result);
      } else {
        result.push_back(words_[at++]);
      }
    }
    return result;
  }

 private:
  static constexpr std::size_t kMostInARow = 8;

  // As if the skill had been written without `like`.
  void write(std::size_t& at, Words& to) {
    for (const std::size_t word : {at, at + 1, at + 4}) to.push_back(words_[word]);
    const Parts parts = read(words_, at);
    const auto append = [&to](const Words& words) { to.insert(to.end(), words.begin(), words.end()); };
    for (const Parts::Parameter& parameter : parts.parameters) append(parameter.words);
    append(parts.kick);
    append(parts.statements);
    SkillToken closing = wordAt(words_, at);  // the bracket, unless the file ends before
    if (closing.kind != Kind::End) ++at;
    closing.kind = Kind::Symbol;
    closing.text = "}";
    to.push_back(closing);
  }

  // The skill that begins at `at`, which goes on to its closing bracket.
  Parts read(const Words& words, std::size_t& at) {
    const std::size_t begin = at;
    const bool like = isLike(words, begin);
    PartReader reader(words, begin + (like ? 5 : 3));
    Parts parts = reader.run();
    if (like && !is(reader.peek(), "}") && reader.peek().kind != Kind::End) {
      note(reader.peek(),
           fmt::format("a skill that is like another one has only parameters and a 'kick' head "
                       "of its own, found '{}'",
                       reader.peek().text));
      parts.whole = false;
    }
    reader.statements(parts.statements);
    if (reader.peek().kind == Kind::End) {
      note(reader.peek(), "the file ends inside a skill: '}' is missing");
      parts.whole = false;
    }
    at = reader.at();
    if (like) {
      parts.statements.clear();
      chain_.push_back(words[begin + 1].text);
      parts = merged(base(words[begin + 3]), std::move(parts));
      chain_.pop_back();
    }
    if (!parts.whole) {
      parts.kick.clear();
      parts.statements.clear();
    }
    return parts;
  }

  Parts base(const SkillToken& name) {
    Parts nothing;
    nothing.whole = false;
    if (std::find(chain_.begin(), chain_.end(), name.text) != chain_.end()) {
      note(name,
           fmt::format("a skill cannot be like itself: {} like {}", fmt::join(chain_, " like "), name.text));
      return nothing;
    }
    if (chain_.size() >= kMostInARow) {
      note(name, fmt::format("more than {} skills in a row, each like the next", kMostInARow));
      return nothing;
    }
    const auto [words, at] = find(name.text);
    if (words == nullptr) {
      note(name, fmt::format("there is no skill '{}'", name.text));
      return nothing;
    }
    std::size_t begin = at;
    return read(*words, begin);
  }

  // `own` goes on top of `base`.
  Parts merged(Parts base, Parts own) const {
    const auto inherit = [this](Words& words) {
      for (SkillToken& word : words) word.heir = chain_.back();
    };
    for (Parts::Parameter& parameter : base.parameters) inherit(parameter.words);
    inherit(base.kick);
    inherit(base.statements);
    const auto inherited = static_cast<std::ptrdiff_t>(base.parameters.size());
    std::set<std::string_view> restated;
    for (Parts::Parameter& parameter : own.parameters) {
      const auto end = base.parameters.begin() + inherited;
      const auto known = std::find_if(base.parameters.begin(), end, [&](const Parts::Parameter& other) {
        return other.name == parameter.name;
      });
      if (known == end) {
        base.parameters.push_back(std::move(parameter));
        continue;
      }
      // The second of one name is an error, which the parser tells.
      parameter.words.front().restates = restated.insert(parameter.name).second;
      known->words.insert(known->words.end(), parameter.words.begin(), parameter.words.end());
    }
    if (!own.kick.empty()) base.kick = std::move(own.kick);
    base.whole = base.whole && own.whole;
    return base;
  }

  std::pair<const Words*, std::size_t> find(std::string_view name) {
    const auto in = [name](const Words& words) {
      std::size_t at = 0;
      while (at < words.size() && !(isSkill(words, at) && words[at + 1].text == name)) ++at;
      return at;
    };
    if (const std::size_t at = in(words_); at < words_.size()) return {&words_, at};
    for (std::size_t i = 0; i < others_.size(); ++i) {
      if (others_[i].file == file_ || others_[i].text.find(name) == std::string::npos) continue;
      // What other files have of characters that mean nothing matters only if the skill stands there.
      std::vector<std::string> errors;
      const bool known = otherWords_[i].has_value();
      if (!known) otherWords_[i] = lexWords(others_[i].text, others_[i].file, &errors);
      const std::size_t at = in(*otherWords_[i]);
      if (at == otherWords_[i]->size()) continue;
      for (const std::string& error : errors) note(error);
      return {&*otherWords_[i], at};
    }
    return {nullptr, 0};
  }

  void note(const std::string& error) {
    if (errors_ == nullptr) throw SkillError(error);
    errors_->push_back(error);
  }
  void note(const SkillToken& token, const std::string& message) { note(errorAt(token, message)); }

  const Words& words_;
  const std::string& file_;
  const std::vector<SkillText>& others_;
  std::vector<std::optional<Words>> otherWords_;  // once they are needed
  std::vector<std::string>* errors_;
  std::vector<std::string_view> chain_;  // skills that are being written out, each like the next
};

}  // namespace

std::vector<SkillToken> writeOutLikes(const std::vector<SkillToken>& words, const std::string& file,
                                      const std::vector<SkillText>& others,
                                      std::vector<std::string>* errors) {
  return Writer(words, file, others, errors).run();
}

}  // namespace nonet::motion
