// Grid convergence: how much a result still depends on the particle spacing.
#pragma once

#include <string>
#include <vector>

namespace lgiw {

/// A result f at a particle spacing h.
struct SpacingResult {
  double spacing, value;  // m; NaN: the run has no such result
};

/// The numerical error of the finest of several results f1 (finest), f2, f3 ... at h1 < h2 < h3 ...
///
/// Observed order p of the three finest: for one ratio r of the spacings p = ln|(f3-f2)/(f2-f1)| / ln r, in general the
/// solution of (f3-f2)/(f2-f1) = r21^p (r32^p - 1) / (r21^p - 1) (Celik et al., J. Fluids Eng. 130, 2008).
/// Grid convergence index GCI = 1.25 |f2-f1| / |f1| / (r21^p - 1) (Roache 1994) and Richardson's value
/// f1 + (f1-f2) / (r21^p - 1). They mean something only where the results converge: with fewer than three of them, with
/// (f3-f2)(f2-f1) <= 0, or with p outside of 0.5 to 2, the spread, largest minus smallest of those used, stands
/// instead.
struct Convergence {
  double order = 0, richardson = 0;  // NaN where there is none; the order stands also where it is not trusted
  double gci = 0, spread = 0;        // over |f1|; NaN for f1 = 0, the GCI also where the spread is used
  double error = 0;                  // in the unit of f: GCI |f1| or the spread; NaN for fewer than two results
  bool use_gci = false;
  std::string why;  // "three finest runs", or why the spread is used
};

/// `results` in any order, no spacing twice.
Convergence convergence_of(std::vector<SpacingResult> results);

/// Dotted keys in which cases differ, besides the particle spacing and what may go with it (h over dp, cells of maps,
/// widths and thresholds in particles, names, threads): what makes a comparison of them more than one of spacings. Each
/// text is YAML that read_case() took.
std::vector<std::string> case_differences(const std::vector<std::string>& case_texts);

}  // namespace lgiw
