// How far a run is from its oracle: the measures of verification.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kardan/app/verify/series.hpp"

namespace kardan::verify {

/// How two histories are compared.
enum class Measure {
  max_error,         ///< largest |s - o| over the oracle's times that the run has
  quaternion_error,  ///< the same, where s and -s are the same rotation
  final_error,       ///< |s - o| at the last of those times
  peak_error,        ///< | max |s| - max |o| |
  largest,           ///< largest |s|; no oracle
  drift,             ///< largest |s - s(first)|; no oracle
  peak_time_error,   ///< |t of the largest |s| - t of the largest |o||
  crossing_error,    ///< largest |t - expected| of the times at which s crosses `level`
  frequency_error,   ///< largest |f / expected - 1| of the frequencies at which s has peaks of its spectrum
  order              ///< order of convergence: log of the quotient of two runs' max_error over log of their dt's
};
/// @throws CaseError for a name that is none of them.
Measure measure_from(const std::string& name);

/// What a measured distance is divided by.
struct Scale {
  enum class Kind { number, peak, initial } kind = Kind::number;  ///< peak: largest |o|; initial: |s(first)|
  double number = 1;
};

/// The part of a figure that is about comparing.
struct Comparison {
  Measure measure = Measure::max_error;
  Scale scale;
  double from = 0, until = 1e300;  ///< times outside are left out
  double level = 0;                ///< crossing_error
  std::vector<double> crossings;   ///< crossing_error: expected times; the run must have at least as many
  std::vector<double> frequencies; ///< frequency_error: expected, cycles per unit of time
  double band = 0.08;              ///< frequency_error: a peak is looked for so far from what is expected, as a share of it
};

/// One number for the distance of `signal` from `oracle` (needed by all measures with an o above). Samples are matched
/// by time, never interpolated: a sample belongs to an oracle's time if they differ by less than 1e-6 of the sampling
/// interval.
/// @throws CaseError if no time matches, or widths differ.
double measure(const Comparison& comparison, const Series& signal, const std::optional<Series>& oracle);

/// Times at which a scalar history crosses `level`, interpolated linearly between its samples.
std::vector<double> crossings(const Series& signal, double level);

/// Frequency at which the spectrum of the equally spaced scalar samples in [from, until], their mean taken off and a Hann window
/// put over them, has its largest value within `band` of `expected`; NaN if there is no peak in it. Components closer
/// than 4 / (until - from) disturb each other.
double frequency(const Series& signal, double from, double until, double expected, double band);

}  // namespace kardan::verify
