// What a series of paired games says about two teams. A pair is two games from one seed with the sides
// exchanged; its value is the goal difference of both games together, per ten minutes, seen from team A.
// Chance that both games share falls out, so pairs are what is counted, not games.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace nonet::lab {

/// Goal difference per ten minutes over all pairs.
struct PairSummary {
  int pairs = 0;
  double mean = 0.0;
  double standardError = 0.0;  // 0 with fewer than two pairs
  double low = 0.0;            // 95 % interval of Student's t; equal to `mean` with fewer than two pairs
  double high = 0.0;
};
/// Equal pairs are no pairs without spread: they count as if one of them were `resolution` off, the value of
/// one goal in one pair.
PairSummary summarizePairs(std::span<const double> values, double resolution);

/// Two claims about the true mean: at most `low`, at least `high`, goals per ten minutes, low < high.
struct SequentialBounds {
  double low = 0.0;
  double high = 0.0;
  friend bool operator==(const SequentialBounds&, const SequentialBounds&) = default;
};
/// "D0,D1". Throws std::runtime_error that says what is expected.
SequentialBounds parseSequentialBounds(std::string_view text);

enum class Verdict : std::uint8_t {
  Open,  // go on
  Low,   // the mean is `low` or less, rather than `high` or more
  High,
};
std::string_view verdictName(Verdict verdict);  // "open", "low", "high"

/// Sequential t-test: after each pair, the ratio of the two claims' likelihoods, each at the spread that fits
/// it best (a generalised likelihood ratio, since the spread is unknown), is held against Wald's bounds
/// [Wald 1945, section 3]. With n values of mean m and sum of
/// squares S about m:
///
///     log ratio = (n - 1) / 2 * log((S + n (m - low)^2) / (S + n (m - high)^2))
///
/// A claim that the mean surpasses is taken at the mean: a difference far beyond both would otherwise look
/// almost as unlikely under the one as under the other, and take fifty pairs instead of six. For a claim that
/// is chosen after the values the ratio is brought kPrice nearer to zero.
///
/// Both kinds of error stay near or below 5 % (the tests simulate them). Goals are whole numbers: a few equal
/// pairs must not pass for pairs without spread, so S begins at the square of `resolution`, the value of one
/// goal in one pair, and nothing is decided before kFewestPairs.
class SequentialTest {
 public:
  static constexpr int kFewestPairs = 6;
  static constexpr double kError = 0.05;  // of each kind
  static constexpr double kPrice = 1.0;   // found by simulation

  SequentialTest(const SequentialBounds& bounds, double resolution);

  /// One more pair. After a verdict further pairs change nothing.
  Verdict add(double value);
  Verdict verdict() const { return verdict_; }
  double logLikelihoodRatio() const { return ratio_; }
  /// The log ratio that decides: +bound() for High, -bound() for Low.
  static double bound();

 private:
  SequentialBounds bounds_;
  double squares_;     // about the mean
  double mean_ = 0.0;  // so far
  int pairs_ = 0;
  double ratio_ = 0.0;
  Verdict verdict_ = Verdict::Open;
};

}  // namespace nonet::lab
