#include "kardan/app/verify/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace kardan::verify {
namespace {

/// The maximum, in which a NaN is not lost: it counts as infinite.
double larger(double a, double b) {
  return std::isnan(b) ? std::numeric_limits<double>::infinity() : std::max(a, b);
}

struct Pair {
  std::size_t signal, oracle;
};

/// Samples of both that stand at the same time.
std::vector<Pair> matched(const Series& signal, const Series& oracle, double from, double until) {
  if (signal.width != oracle.width)
    throw CaseError("the signal has " + std::to_string(signal.width) + " components, the oracle " +
                    std::to_string(oracle.width));
  std::vector<Pair> pairs;
  if (signal.size() < 2) throw CaseError("the run has less than two samples");
  const double tolerance = 1e-6 * (signal.time[1] - signal.time[0]);
  for (std::size_t i = 0, o = 0; o < oracle.size(); ++o) {
    const double t = oracle.time[o];
    while (i < signal.size() && signal.time[i] < t - tolerance) ++i;
    if (i == signal.size()) break;
    if (signal.time[i] <= t + tolerance && t >= from - tolerance && t <= until + tolerance) pairs.push_back({i, o});
  }
  if (pairs.empty()) throw CaseError("no sample of the run stands at a time of the oracle");
  return pairs;
}

double distance(std::span<const double> a, std::span<const double> b, double sign) {
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += (a[c] - sign * b[c]) * (a[c] - sign * b[c]);
  return std::sqrt(sum);
}

double peak(const Series& series, double from, double until) {
  double largest = 0;
  for (std::size_t i = 0; i < series.size(); ++i)
    if (series.time[i] >= from && series.time[i] <= until) largest = larger(largest, length(series.at(i)));
  return largest;
}

double scaled(const Comparison& c, double value, const Series& signal, const std::optional<Series>& oracle) {
  double scale = c.scale.number;
  if (c.scale.kind == Scale::Kind::peak) scale = peak(oracle ? *oracle : signal, c.from, c.until);
  if (c.scale.kind == Scale::Kind::initial) scale = length(signal.at(0));
  if (!(scale > 0)) throw CaseError("the scale is zero");
  return value / scale;
}

double largest_error(const Comparison& c, const Series& signal, const Series& oracle, bool rotations) {
  double largest = 0;
  for (const auto& [s, o] : matched(signal, oracle, c.from, c.until)) {
    double error = distance(signal.at(s), oracle.at(o), 1);
    if (rotations) error = std::min(error, distance(signal.at(s), oracle.at(o), -1));
    largest = larger(largest, error);
  }
  return largest;
}

double drift(const Comparison& c, const Series& signal) {
  double largest = 0;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    if (signal.time[i] < c.from || signal.time[i] > c.until) continue;
    largest = larger(largest, distance(signal.at(i), signal.at(0), 1));
  }
  return largest;
}

double crossing_error(const Comparison& c, const Series& signal) {
  const auto times = crossings(signal, c.level);
  if (times.size() < c.crossings.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < c.crossings.size(); ++i) largest = std::max(largest, std::abs(times[i] - c.crossings[i]));
  return largest;
}

double peak_time(const Series& series, double from, double until) {
  double largest = -1, time = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (series.time[i] < from || series.time[i] > until || !(length(series.at(i)) > largest)) continue;
    largest = length(series.at(i));
    time = series.time[i];
  }
  return time;
}

double frequency_error(const Comparison& c, const Series& signal) {
  if (c.frequencies.empty()) throw CaseError("a frequency_error needs \"frequencies\"");
  double largest = 0;
  for (const double f : c.frequencies)
    largest = larger(largest, std::abs(frequency(signal, c.from, c.until, f, c.band) / f - 1));
  return largest;
}

}  // namespace

Measure measure_from(const std::string& name) {
  static const std::array<std::pair<const char*, Measure>, 10> names{{{"max_error", Measure::max_error},
                                                                     {"quaternion_error", Measure::quaternion_error},
                                                                     {"final_error", Measure::final_error},
                                                                     {"peak_error", Measure::peak_error},
                                                                     {"largest", Measure::largest},
                                                                     {"drift", Measure::drift},
                                                                     {"peak_time_error", Measure::peak_time_error},
                                                                     {"crossing_error", Measure::crossing_error},
                                                                     {"frequency_error", Measure::frequency_error},
                                                                     {"order", Measure::order}}};
  for (const auto& [text, value] : names)
    if (name == text) return value;
  throw CaseError("no measure \"" + name + "\"");
}

std::vector<double> crossings(const Series& signal, double level) {
  std::vector<double> times;
  for (std::size_t i = 1; i < signal.size(); ++i) {
    const double a = signal.values[(i - 1) * signal.width] - level, b = signal.values[i * signal.width] - level;
    if ((a < 0) != (b < 0)) times.push_back(signal.time[i - 1] + (signal.time[i] - signal.time[i - 1]) * (a / (a - b)));
  }
  return times;
}

double frequency(const Series& signal, double from, double until, double expected, double band) {
  std::vector<double> x;
  double mean = 0;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    if (signal.time[i] >= from && signal.time[i] <= until) x.push_back(signal.values[i * signal.width]);
  }
  if (x.size() < 8) throw CaseError("a frequency needs at least eight samples");
  for (const double v : x) mean += v / static_cast<double>(x.size());
  const double count = static_cast<double>(x.size()), turn = 2 * std::numbers::pi;
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = (x[i] - mean) * (1 - std::cos(turn * (static_cast<double>(i) + 0.5) / count));

  const double interval = signal.time[1] - signal.time[0];
  const auto power = [&](double f) {
    double re = 0, im = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double phase = turn * f * interval * static_cast<double>(i);
      re += x[i] * std::cos(phase);
      im += x[i] * std::sin(phase);
    }
    return re * re + im * im;
  };
  // Coarse search in steps much finer than the width of a peak, twice more around the best, then a parabola.
  double best = expected, step = std::min(band * expected, 1 / (count * interval)) / 8, reach = band * expected;
  for (int round = 0; round < 3; ++round, reach = 2 * step, step /= 16) {
    const double centre = best;
    const int half = static_cast<int>(std::ceil(reach / step));
    int at = -half;
    double largest = -1;
    for (int k = -half; k <= half; ++k) {
      if (const double p = power(centre + k * step); p > largest) largest = p, at = k;
    }
    if (at == -half || at == half) return std::numeric_limits<double>::quiet_NaN();
    best = centre + at * step;
  }
  const double left = power(best - step), middle = power(best), right = power(best + step);
  return best + 0.5 * step * (left - right) / (left - 2 * middle + right);
}

double measure(const Comparison& c, const Series& signal, const std::optional<Series>& oracle) {
  const auto needed = [&]() -> const Series& {
    if (!oracle) throw CaseError("the measure needs an oracle");
    return *oracle;
  };
  switch (c.measure) {
    case Measure::max_error:
      return scaled(c, largest_error(c, signal, needed(), false), signal, oracle);
    case Measure::quaternion_error:
      return scaled(c, largest_error(c, signal, needed(), true), signal, oracle);
    case Measure::final_error: {
      const Pair last = matched(signal, needed(), c.from, c.until).back();
      return scaled(c, distance(signal.at(last.signal), oracle->at(last.oracle), 1), signal, oracle);
    }
    case Measure::peak_error: {
      const double reached = peak(signal, c.from, c.until), wanted = peak(needed(), c.from, c.until);
      return scaled(c, std::abs(reached - wanted), signal, oracle);
    }
    case Measure::largest:
      return scaled(c, peak(signal, c.from, c.until), signal, oracle);
    case Measure::drift:
      return scaled(c, drift(c, signal), signal, oracle);
    case Measure::peak_time_error:
      return scaled(c, std::abs(peak_time(signal, c.from, c.until) - peak_time(needed(), c.from, c.until)), signal, oracle);
    case Measure::frequency_error:
      return frequency_error(c, signal);
    case Measure::crossing_error:
      return crossing_error(c, signal);
    case Measure::order:
      break;
  }
  throw CaseError("an order of convergence is measured on two runs");
}

}  // namespace kardan::verify
