// How a slide entered the water, as the run has it: what empirical wave formulas start from.
//
// A slide seldom arrives as one block at one time: many start at the water's edge, at rest, and run in for half a
// minute. So each piece of it is measured on its own as it passes the still-water shoreline of the bed, where the
// laboratory measured its slides: the water has not yet slowed and heaped it there. What stands over deeper bed from
// the start is measured as it sinks through still water level. Only pieces that start above still water level and sink
// below it count.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"
#include "measure/surface_sampling.hh"

namespace lgiw {

/// SI, degrees; in 2-D volumes are per metre of width and the width is 1 m. Without any volume all else is NaN.
struct SlideEntry {
  double volume = 0;                                    // that sank below still water level
  double submerged_volume = 0;                          // of the slide, under still water level from the start
  double speed = no_value;                              // mean over that volume of the speed at the shoreline
  double slow_speed = no_value, fast_speed = no_value;  // its 10th and 90th percentile
  double slope = no_value;                              // of the mean velocity there, below the horizontal
  /// Of the rectangle across the direction whose places have the same standard deviation.
  double width = no_value;
  /// Flux over width and speed, the largest of ten parts of the volume in the order of their passage: the thickest
  /// part, across the direction of motion, as a mean over the width.
  double thickness = no_value;
  double x = no_value, y = no_value;        // mean place of the passage, in the case's CRS
  std::array<double, 2> ahead{1, 0};        // unit vector in plan of the mean velocity
  double direction = no_value;              // the same, degrees clockwise from north
  double start = no_value, end = no_value;  // s: when 5 and 95 per cent of the volume had passed
  double drop = no_value;                   // m that it sank on its way from the start to the shoreline, mean
  double travel_slope = no_value;           // degrees: of the straight line of that way
};

/// The particles, or for a rigid slide the pieces, of a slide.
struct SlidePieces {
  std::vector<float> points, velocity;  // [n,3] local
};

/// Follows the pieces of a slide frame by frame; their order is the same in all.
class SlideEntryRecorder {
 public:
  /// `size` and `volume` of a piece; `header` must outlive the recorder.
  SlideEntryRecorder(const ParticleHeader& header, double size, double volume);
  void add(double time, SlidePieces pieces);
  SlideEntry entry() const;

 private:
  struct Passage {
    bool there = false, sunk = false;  // past the shoreline; below the level too
    double time, duration;             // the piece takes so long to pass
    std::array<double, 3> place, velocity;
    double speed() const;
  };
  double bed_above_level(const SlidePieces& pieces, std::size_t piece) const;

  const ParticleHeader& header_;
  double size_, volume_, first_time_ = 0, last_time_ = 0;
  SlidePieces first_, last_;
  std::vector<Passage> passages_;  // of every piece
};

/// The soil that is slide at the end of the run (its plastic strain above the threshold), over all frames; without soil
/// the first rigid body that enters the water, which is taken apart into pieces of the particle size. No volume where
/// there is neither, or no water.
SlideEntry measure_slide_entry(const RunReader& run, const Case& c);

/// The water at rest before the slide, on its axis.
struct WaterAhead {
  double x = no_value,
         y = no_value;      // in the case's CRS: its edge, ahead of where the slide passes; distances are from here
  double depth = no_value;  // m
};
/// The depth is the greatest that is no farther from the edge than five times itself. Laboratory channels and basins
/// are flat beyond the foot of the slope, and the wave is full-grown there (x_M is 5.5 sqrt(P) depths away); a basin
/// that gets deeper only farther out does not count. Where the water is too shallow all along for that, the greatest of
/// all. NaN without water ahead. `first_water` [ny,nx] local.
WaterAhead water_ahead(const RunHeader& header, const std::vector<float>& first_water, const SlideEntry& entry);

}  // namespace lgiw
