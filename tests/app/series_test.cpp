// A series from the command line, and the page about it.
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/browser.h"
#include "app/program.h"

namespace nonet::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(SeriesCommand, PlaysPairsAndReportsThem) {
  const TestFolder folder("nonet_series");
  const std::string out = folder.file("games");
  Program series({"series", "own", "own", "--b-set", "team.ball.kick=false", "--b-name", "walkers", "--pairs",
                  "1", "--minutes", "0.1", "--players", "2", "--jobs", "2", "--out", out},
                 folder.file("1.txt"));
  ASSERT_EQ(series.wait(), 0) << series.output();
  EXPECT_THAT(series.output(), HasSubstr("2 games"));

  Program report({"report", out}, folder.file("2.txt"));
  ASSERT_EQ(report.wait(), 0) << report.output();
  std::ifstream file(out + "/report.html");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(page, HasSubstr("A against walkers"));
  EXPECT_THAT(page, HasSubstr("team.ball.kick=false"));
  EXPECT_THAT(page, Not(HasSubstr("http://"))) << "it needs nothing else";
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  for (const char* tag : {"svg", "table", "figure", "tr"}) {
    const std::string open = std::string("<") + tag;
    EXPECT_EQ(occurrences(page, open + ">") + occurrences(page, open + " "),
              occurrences(page, std::string("</") + tag + ">"))
        << tag;
  }
  if (const auto browser = Browser::find()) {
    const Picture picture =
        browser->screenshot("file://" + out + "/report.html", folder.file("profile"), folder.file("1.png"));
    EXPECT_GT(picture.share([](int r, int g, int b) { return r < 100 && g < 100 && b < 100; }), 0.002)
        << "text is drawn";
  }
}

TEST(SeriesCommand, ReportWantsAFinishedSeries) {
  const TestFolder folder("nonet_report");
  Program report({"report", folder.file("")}, folder.file("1.txt"));
  EXPECT_EQ(report.wait(), 1);
  EXPECT_THAT(report.output(), HasSubstr("holds no finished series: play one with nonet series"));
}

}  // namespace
}  // namespace nonet::app
