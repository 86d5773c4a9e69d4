#include "nonet/config/layers.h"

#include <gtest/gtest.h>

#include "nonet/config/assignment.h"

namespace nonet::config {
namespace {

struct OneOfEach {
  double real = 1.5;
  int integer = 3;
  bool boolean = true;
  std::string text = "name";
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit({"real", Unit::None, {0.0, 10.0}, fixed, "A number"}, self.real);
    visit({"integer", Unit::None, {1, 9}, fixed, "A whole number"}, self.integer);
    visit({"boolean", Unit::None, {}, fixed, "A switch"}, self.boolean);
    visit({"text", Unit::None, {}, fixed, "A text"}, self.text);
  }
};

TEST(Layers, NameTheLastThatSetAValueOfAnyKind) {
  Layers<OneOfEach> layers(OneOfEach{}, "code");
  EXPECT_EQ(layers.origins(), std::vector<std::string>(4, "code"));
  layers.add("file", [](OneOfEach& all) { overlayText(all, "real = 2.0\ntext = \"name\"\n", "a.toml"); });
  EXPECT_EQ(layers.origins(), (std::vector<std::string>{"file", "code", "code", "file"}));
  layers.add("option", [](OneOfEach& all) {
    assignParameter(all, "integer=4");
    assignParameter(all, "boolean=true");
    assignParameter(all, "text=other");
  });
  EXPECT_EQ(layers.origins(), (std::vector<std::string>{"file", "option", "option", "option"}));
  EXPECT_EQ(layers.parameters().text, "other");
  EXPECT_EQ(layers.parameters().integer, 4);
}

}  // namespace
}  // namespace nonet::config
