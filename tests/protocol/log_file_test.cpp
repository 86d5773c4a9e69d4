#include "nonet/protocol/log_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include "nonet/math/random.h"

#include "golden.h"

namespace nonet::protocol {
namespace {

namespace fs = std::filesystem;

class LogFile : public testing::Test {
 protected:
  LogFile()
      : folder_(fs::temp_directory_path() / ("nonet_log_test_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~LogFile() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

  fs::path folder_;
};

LogHeader header() {
  LogHeader header;
  header.version = "1.2.3";
  header.team = "Nonet \"A\"";
  header.unum = 9;
  header.robotType = 4;
  header.seed = 18446744073709551615ULL;
  header.parameters = "[walk]\nspeed = 0.5 # fast\nname = \"x\"\n";
  header.options = {{"startPose", "-1.0 2.0 0.0"}};
  return header;
}

struct Contents {
  std::vector<std::string> lines;  // kind and text
  LogReader::End end = LogReader::End::Whole;
  std::string problem;
};

Contents readAll(LogReader& reader) {
  Contents contents;
  std::size_t number = 0;
  for (LogLine line; reader.next(line);) {
    contents.lines.push_back(std::to_string(static_cast<int>(line.kind)) + std::string(line.text));
    EXPECT_EQ(line.number, ++number);
  }
  contents.end = reader.end();
  contents.problem = reader.problem();
  return contents;
}

Contents readAll(const std::string& path) {
  LogReader reader(path);
  return readAll(reader);
}

TEST_F(LogFile, WhatIsWrittenIsReadBack) {
  const auto received = goldenLines(LogLine::Kind::Received);
  const auto sent = goldenLines(LogLine::Kind::Sent);
  {
    LogWriter writer(path("a.zst"), header());
    for (std::size_t i = 0; i < received.size(); ++i) {
      writer.received(received[i]);
      writer.sent(sent[i % sent.size()]);
      if (i % 10 == 0) writer.truth("{\"t\":1}");
    }
    writer.comment("done");
    writer.received("torn\nin\rtwo");
    EXPECT_FALSE(writer.failed());
  }
  EXPECT_LT(fs::file_size(path("a.zst")), 120000U);
  LogReader reader(path("a.zst"));
  ASSERT_TRUE(reader.header());
  EXPECT_EQ(*reader.header(), header());
  const Contents contents = readAll(reader);
  EXPECT_EQ(contents.end, LogReader::End::Whole);
  EXPECT_EQ(contents.problem, "");
  std::vector<std::string> expected;
  for (std::size_t i = 0; i < received.size(); ++i) {
    expected.push_back("0" + received[i]);
    expected.push_back("1" + sent[i % sent.size()]);
    if (i % 10 == 0) expected.emplace_back("2{\"t\":1}");
  }
  expected.emplace_back("3done");
  expected.emplace_back("0torn in two");
  ASSERT_FALSE(contents.lines.empty());
  EXPECT_EQ(contents.lines[0].substr(0, 12), "3nonet-log 1");
  EXPECT_EQ(std::vector<std::string>(contents.lines.begin() + 1, contents.lines.end()), expected);
}

// The state of the file while the writer lives is the one that a killed process leaves.
TEST_F(LogFile, AKilledWriterLosesLessThanFiftyCycles) {
  const auto received = goldenLines(LogLine::Kind::Received);
  LogWriter writer(path("a.zst"), header());
  EXPECT_EQ(readAll(path("a.zst")).lines.size(), 1U);
  std::size_t written = 0;
  for (int i = 0; i < 1234; ++i) {
    writer.received(received[static_cast<std::size_t>(i) % received.size()]);
    ++written;
    writer.sent("(syn)");
    ++written;
    if (i % 100 == 77) {
      const Contents contents = readAll(path("a.zst"));
      EXPECT_EQ(contents.end, LogReader::End::Torn);
      EXPECT_NE(contents.problem.find("a.zst"), std::string::npos) << contents.problem;
      EXPECT_GE(contents.lines.size() + 100, written);
    }
  }
  writer.flush();
  EXPECT_EQ(readAll(path("a.zst")).lines.size(), written + 1);
}

TEST_F(LogFile, PlainGzipAndZstdAreToldApart) {
  const std::string text = "# comment\n< (time (now 1.00))\n> (syn)\n= {}\nsomething\n\n<\n< \n";
  const std::vector<std::string> expected = {
      "3comment", "0(time (now 1.00))", "1(syn)", "2{}", "4something", "4", "4<", "0"};
  EXPECT_EQ(readAll(write("plain", text)).lines, expected);
  EXPECT_EQ(readAll(write("dos", "< a\r\n> b\r\n")).lines, (std::vector<std::string>{"0a", "1b"}));

  gzFile zipped = gzopen(path("zipped").c_str(), "wb");
  gzwrite(zipped, text.data(), static_cast<unsigned>(text.size()));
  gzclose(zipped);
  EXPECT_EQ(readAll(path("zipped")).lines, expected);

  std::string compressed(1000, '\0');
  compressed.resize(ZSTD_compress(compressed.data(), compressed.size(), text.data(), text.size(), 3));
  EXPECT_EQ(readAll(write("compressed", compressed)).lines, expected);

  // Two members or frames, one after the other, are one text.
  for (const std::string& once : {compressed, contents(path("zipped"))}) {
    const Contents twice = readAll(write("twice", once + once));
    EXPECT_EQ(twice.lines.size(), 2 * expected.size());
    EXPECT_EQ(twice.end, LogReader::End::Whole);
  }
}

// Cut anywhere, in any of the three forms: whole lines are given, all of them right, and the tear is
// reported.
TEST_F(LogFile, TornAnywhere) {
  const auto received = goldenLines(LogLine::Kind::Received);
  std::string text;
  for (int i = 0; i < 20; ++i) {
    text += "< " + received[static_cast<std::size_t>(i)] + "\n";
  }
  std::string compressed(text.size() + 1000, '\0');
  compressed.resize(ZSTD_compress(compressed.data(), compressed.size(), text.data(), text.size(), 3));
  gzFile zipped = gzopen(path("zipped").c_str(), "wb");
  gzwrite(zipped, text.data(), static_cast<unsigned>(text.size()));
  gzclose(zipped);
  for (const std::string& whole : {text, compressed, contents(path("zipped"))}) {
    for (std::size_t length = 1; length < whole.size(); length += 1 + whole.size() / 300) {
      const Contents torn = readAll(write("torn", whole.substr(0, length)));
      for (std::size_t i = 0; i < torn.lines.size(); ++i) {
        ASSERT_EQ(torn.lines[i], "0" + received[i]);
      }
      const bool betweenLines = whole == text && whole[length - 1] == '\n';
      ASSERT_EQ(torn.end, betweenLines ? LogReader::End::Whole : LogReader::End::Torn) << length;
      ASSERT_EQ(torn.problem.empty(), torn.end == LogReader::End::Whole);
    }
  }
}

TEST_F(LogFile, WhatThereIsOfATornLineIsGiven) {
  LogReader torn(write("torn", "< a\n> bc"));
  EXPECT_EQ(readAll(torn).lines.size(), 1U);
  EXPECT_EQ(torn.tornLine(), "> bc");
  LogReader whole(write("whole", "< a\n"));
  EXPECT_EQ(readAll(whole).lines.size(), 1U);
  EXPECT_EQ(whole.tornLine(), "");
}

TEST_F(LogFile, DamageEndsTheReadingCleanly) {
  {
    LogWriter writer(path("a.zst"), header(), 1);
    for (const std::string& line : goldenLines(LogLine::Kind::Received)) {
      writer.received(line);
    }
  }
  const std::string whole = contents(path("a.zst"));
  Random random(12);
  int damaged = 0;
  for (int i = 0; i < 200; ++i) {
    std::string broken = whole;
    broken[8 + random.below(broken.size() - 8)] ^= static_cast<char>(1 + random.below(255));
    try {
      damaged += readAll(write("broken", broken)).end != LogReader::End::Whole ? 1 : 0;
    } catch (const LogError&) {  // the header was hit
      ++damaged;
    }
  }
  EXPECT_EQ(damaged, 200);  // the checksum finds every changed byte
  EXPECT_EQ(readAll(write("zstd magic only", "\x28\xB5\x2F\xFD garbage garbage")).end,
            LogReader::End::Damaged);
}

std::string errorOf(const std::string& path) {
  try {
    LogReader reader(path);
  } catch (const LogError& error) {
    return error.what();
  }
  return "";
}

TEST_F(LogFile, ErrorsNameTheFile) {
  EXPECT_NE(errorOf(path("missing")).find(path("missing") + ": "), std::string::npos);
  EXPECT_NE(errorOf(folder_.string()).find("directory"), std::string::npos);
  const std::string broken = errorOf(write("broken", "# nonet-log 1 {\"version\"\n"));
  EXPECT_NE(broken.find(path("broken") + ": the header line"), std::string::npos) << broken;
  EXPECT_THROW(LogReader(path("broken")), DamagedLog);
  const std::string future = errorOf(write("future", "# nonet-log 2 {}\n"));
  EXPECT_NE(future.find("format 2"), std::string::npos) << future;
  EXPECT_NE(errorOf(write("bare", "# nonet-log 1\n")), "");
  EXPECT_THROW(LogWriter(path("no/such/folder"), header()), LogError);
  EXPECT_EQ(readAll(write("empty", "")).end, LogReader::End::Whole);
}

// The first was found by the fuzzer.
TEST_F(LogFile, NumbersOfTheHeaderAreWholeAndFit) {
  const auto errorWith = [this](const std::string& numbers) {
    return errorOf(
        write("log", R"(# nonet-log 1 {"version":"1","team":"A","parameters":"",)" + numbers + "}\n"));
  };
  for (const char* wrong : {R"("unum":3,"type":4,"seed":18446744073709551616)",
                            R"("unum":3,"type":4,"seed":-1)", R"("unum":3,"type":4,"seed":1.5)",
                            R"("unum":3,"type":4,"seed":"7")", R"("unum":4294967299,"type":4,"seed":7)",
                            R"("unum":3,"type":-2147483649,"seed":7)", R"("unum":true,"type":4,"seed":7)"}) {
    EXPECT_NE(errorWith(wrong).find(path("log") + ": the header line"), std::string::npos) << wrong;
  }
  EXPECT_EQ(errorWith(R"("unum":-3,"type":4,"seed":18446744073709551615)"), "");
}

TEST_F(LogFile, AFullDiskStopsTheRecordingOnly) {
  if (!fs::exists("/dev/full")) {
    GTEST_SKIP() << "no /dev/full here";
  }
  LogWriter writer("/dev/full", header());
  for (int i = 0; i < 200; ++i) {
    writer.received("(time (now 1.00))");
  }
  writer.close();
  EXPECT_TRUE(writer.failed());
  EXPECT_NE(writer.error().find("/dev/full: "), std::string::npos) << writer.error();
}

}  // namespace
}  // namespace nonet::protocol
