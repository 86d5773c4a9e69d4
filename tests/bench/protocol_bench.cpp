// Speed of the protocol code on recorded messages, and of a generic S-expression library on the same
// messages.
//
// The rival is sfsexp ("Small Fast S-Expression library", Debian libsexp-dev), the parser that the reference
// server itself uses. sfsexpTree times building and freeing its tree of strings only. sfsexpValues also
// visits the tree once and converts the numbers in it, which is the least that parsePercept()'s result takes.
#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "nonet/protocol/effectors.h"
#include "nonet/protocol/framing.h"
#include "nonet/protocol/log_file.h"
#include "nonet/protocol/percept_text.h"

#ifdef NONET_BENCH_SFSEXP
#include <sfsexp/sexp.h>
#endif

namespace {

using namespace nonet::protocol;

enum Corpus { kAll, kLongest };

std::vector<std::string> recorded(LogLine::Kind kind, Corpus corpus) {
  std::vector<std::string> messages;
  LogReader reader(NONET_TEST_DATA "/protocol/golden.log.gz");
  for (LogLine line; reader.next(line);) {
    if (line.kind == kind) {
      messages.emplace_back(line.text);
    }
  }
  if (corpus == kLongest) {
    messages = {*std::max_element(messages.begin(), messages.end(),
                                  [](const auto& a, const auto& b) { return a.size() < b.size(); })};
  }
  return messages;
}

void count(benchmark::State& state, const std::vector<std::string>& messages) {
  std::size_t bytes = 0;
  for (const std::string& message : messages) {
    bytes += message.size();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * messages.size()));
  state.counters["us_per_message"] =
      benchmark::Counter(static_cast<double>(state.iterations() * messages.size()) * 1e-6,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void parsePercepts(benchmark::State& state, Corpus corpus) {
  const auto messages = recorded(LogLine::Kind::Received, corpus);
  Percept percept;
  for (auto _ : state) {
    for (const std::string& message : messages) {
      parsePercept(message, percept);
      benchmark::DoNotOptimize(percept);
    }
  }
  count(state, messages);
}
BENCHMARK_CAPTURE(parsePercepts, all, kAll);
BENCHMARK_CAPTURE(parsePercepts, longest, kLongest);

#ifdef NONET_BENCH_SFSEXP
double sumOfNumbers(const sexp_t* node) {
  double sum = 0.0;
  for (; node != nullptr; node = node->next) {
    if (node->ty == SEXP_LIST) {
      sum += sumOfNumbers(node->list);
    } else {
      double value = 0.0;
      std::from_chars(node->val, node->val + node->val_used, value);
      sum += value;
    }
  }
  return sum;
}

template <typename Use>
void rival(benchmark::State& state, Corpus corpus, Use use) {
  const auto messages = recorded(LogLine::Kind::Received, corpus);
  // It reads one expression per call; a message is many, so they are put into one list.
  std::vector<std::string> lists;
  for (const std::string& message : messages) {
    lists.push_back("(" + message + ")");
  }
  for (auto _ : state) {
    for (std::string& list : lists) {
      sexp_t* tree = parse_sexp(list.data(), list.size());
      if (tree == nullptr) {
        state.SkipWithError("the rival did not understand a message");
        return;
      }
      benchmark::DoNotOptimize(use(tree));
      destroy_sexp(tree);
    }
  }
  count(state, messages);
}

void sfsexpTree(benchmark::State& state, Corpus corpus) {
  rival(state, corpus, [](const sexp_t* tree) { return tree; });
}
void sfsexpValues(benchmark::State& state, Corpus corpus) {
  rival(state, corpus, sumOfNumbers);
}
BENCHMARK_CAPTURE(sfsexpTree, all, kAll);
BENCHMARK_CAPTURE(sfsexpTree, longest, kLongest);
BENCHMARK_CAPTURE(sfsexpValues, all, kAll);
BENCHMARK_CAPTURE(sfsexpValues, longest, kLongest);
#endif

void writePercepts(benchmark::State& state, Corpus corpus) {
  const auto messages = recorded(LogLine::Kind::Received, corpus);
  std::vector<Percept> percepts(messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    parsePercept(messages[i], percepts[i]);
  }
  std::string text;
  for (auto _ : state) {
    for (const Percept& percept : percepts) {
      writePercept(percept, text);
      benchmark::DoNotOptimize(text);
    }
  }
  count(state, messages);
}
BENCHMARK_CAPTURE(writePercepts, all, kAll);
BENCHMARK_CAPTURE(writePercepts, longest, kLongest);

void parseAnswers(benchmark::State& state) {
  const auto messages = recorded(LogLine::Kind::Sent, kAll);
  Effectors effectors;
  for (auto _ : state) {
    for (const std::string& message : messages) {
      benchmark::DoNotOptimize(parseEffectors(message, effectors));
    }
  }
  count(state, messages);
}
BENCHMARK(parseAnswers);

void writeAnswers(benchmark::State& state) {
  const auto messages = recorded(LogLine::Kind::Sent, kAll);
  std::vector<Effectors> effectors(messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    parseEffectors(messages[i], effectors[i]);
  }
  std::string text;
  for (auto _ : state) {
    for (const Effectors& one : effectors) {
      writeEffectors(one, text);
      benchmark::DoNotOptimize(text);
    }
  }
  count(state, messages);
}
BENCHMARK(writeAnswers);

void roundAnswers(benchmark::State& state) {
  const auto messages = recorded(LogLine::Kind::Sent, kAll);
  std::vector<Effectors> effectors(messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    parseEffectors(messages[i], effectors[i]);
  }
  for (auto _ : state) {
    for (Effectors one : effectors) {
      roundAsWritten(one);
      benchmark::DoNotOptimize(one);
    }
  }
  count(state, messages);
}
BENCHMARK(roundAnswers);

void recordCycles(benchmark::State& state) {
  const auto received = recorded(LogLine::Kind::Received, kAll);
  const auto sent = recorded(LogLine::Kind::Sent, kAll);
  LogWriter writer("/dev/null", LogHeader{});
  for (auto _ : state) {
    for (std::size_t i = 0; i < received.size(); ++i) {
      writer.received(received[i]);
      writer.sent(sent[i % sent.size()]);
    }
  }
  count(state, received);
}
BENCHMARK(recordCycles);

}  // namespace
