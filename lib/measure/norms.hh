// How far a computed series, profile or set of run-ups is from a measured one. The norms are those of tsunami-model
// benchmarks; nothing is ever shifted, scaled or fitted to the reference.
#pragma once

#include <cstddef>
#include <vector>

namespace lgiw {

/// A quantity against time. `time` rises strictly; a value may be NaN (none was measured, or the place was dry).
struct Series {
  std::vector<double> time, value;
};

/// Linear between the samples beside `time`; NaN outside the series and where either sample is NaN.
double value_at(const Series& series, double time);

/// The part from time `from` to `to`, with interpolated ends.
Series part_of(const Series& series, double from, double to);

struct Extreme {
  double value, time;  // NaN where there is none
};

/// Highest value in the first stretch above zero that rises above `threshold`; lowest in the first below -threshold.
Extreme first_crest(const Series& series, double threshold);
Extreme first_trough(const Series& series, double threshold);

/// First time at which |value| exceeds `threshold`, linear between samples; NaN: never.
double arrival_time(const Series& series, double threshold);

/// What is read off one series.
struct SeriesFeatures {
  Extreme highest, lowest, crest, trough;  // over all; the first
  double arrival;
};
SeriesFeatures features_of(const Series& series, double threshold);

/// Norms of a computed series P against a reference O. P is interpolated linearly at the times of O, within the
/// overlap of both; the sums run over the n samples where both have a value.
struct SeriesNorms {
  std::size_t samples = 0;        // n
  double from = 0, to = 0;        // s: the overlap
  SeriesFeatures run, reference;  // of either's own samples within the overlap
  double rmse = 0;                // sqrt(sum (P - O)^2 / n)
  double nrmse = 0;               // RMSE / (max O - min O)
  double mae = 0;                 // sum |P - O| / n
  double willmott_d = 0;          // 1 - sum (P - O)^2 / sum (|P - mean O| + |O - mean O|)^2, Willmott (1981); 1 is best
  double phase_lag = 0;           // s by which P comes later: where their correlation is highest; reported only
  double correlation = 0;         // that highest correlation
};

/// Compares over the overlap; arrival, first crest and first trough by `threshold` (in the unit of the values).
/// The lag is sought among the shifts of up to a quarter of the overlap on an even grid of time, as the highest Pearson
/// coefficient of what then lies over each other, refined by a parabola through it and its neighbours; NaN where it
/// would lie beyond. Everything is NaN and `samples` 0 where the series do not overlap.
SeriesNorms compare_series(const Series& run, const Series& reference, double threshold);

/// Geometric mean K and geometric standard deviation kappa of the ratios O_i / P_i of measured and computed run-ups,
/// Aida (1978): ln K = mean ln(O_i/P_i), ln kappa = sqrt(mean (ln(O_i/P_i))^2 - (ln K)^2). A good set has K from 0.95
/// to 1.05 and kappa below 1.45. Both are NaN for an empty set and where a value is not positive.
struct AidaNumbers {
  double K, kappa;
};
AidaNumbers aida_numbers(const std::vector<double>& run, const std::vector<double>& reference);

/// The surface of soil along a line. `distance` rises, m; `bed` and `soil` are elevations, m; soil NaN: none there.
struct SurfaceProfile {
  std::vector<double> distance, bed, soil;
};

struct ProfileNorms {
  std::size_t samples = 0;
  double rms_distance = 0;  // m: root mean square of the shortest distances from the reference's points to the profile
  double rms_height = 0;    // m: of the vertical distances
  double front_run = 0, front_reference = 0;    // m: farthest place that is thicker than `toe`
  double height_run = 0, height_reference = 0;  // m: highest surface where the reference has points
};

/// Compares a profile with points (distance, elevation) of a measured surface. Where the profile has no soil its
/// surface is the bed. Thickness is above the profile's bed for both. `direction` is 1 where the front looks towards
/// larger distances, -1 towards smaller ones. Points beyond the profile's ends are left out.
ProfileNorms compare_profiles(const SurfaceProfile& run, const std::vector<double>& distance,
                              const std::vector<double>& elevation, double toe, int direction);

/// 100 (run - reference) / |reference|; NaN for a reference of 0.
double percent_error(double run, double reference);

}  // namespace lgiw
