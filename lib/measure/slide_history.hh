// Slide volume, volume in the water, speeds and the bookkeeping of the soil, and the shape of the deposit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "files/run_file.hh"

namespace lgiw {

/// One frame. Volumes in m3 (in 2-D per metre of width), speeds in m/s, positions in the case's CRS.
struct SlideState {
  double time = 0;
  double slide_volume = 0;     // soil whose accumulated plastic strain is above the threshold
  double unmoved_volume = 0;   // the other soil in the domain
  double lost_volume = 0;      // soil that has left the domain
  double immersed_volume = 0;  // soil below still water level minus that at the start; NaN without water
  // Of what is part of the slide at the end of the run, so that they are those of one body at all times; NaN without
  // one.
  double mean_speed = 0, p99_speed = 0, max_speed = 0;  // p99: 99th percentile, free of single grains
  std::array<double, 3> centre{};
};

/// The slide at the end. NaN where there is none.
struct SlideDeposit {
  double direction = 0;           // of the motion of its centre in plan, degrees clockwise from north; in 2-D 90 or 270
  double length = 0, width = 0;   // m along and across that direction; width NaN in 2-D
  double height_above_water = 0;  // m above still water level
  double runout = 0;              // m that the centre moved in plan
  /// Of all soil of the run: how far its 99th percentile along that direction has moved, m, and in 2-D where it is (x
  /// in the case's CRS; NaN in 3-D). Free of single grains, as they splash farther at every refinement.
  double front_runout = 0, front_x = 0;
};

/// Follows the slide of a run frame by frame.
class SlideHistory {
 public:
  /// `last` is the run's last frame: it tells what is part of the slide at the end.
  SlideHistory(const RunHeader& header, const Frame& last, double adps_threshold);

  /// Volumes of a particle on the still water level are divided. slide + unmoved + lost is the volume of all soil: this
  /// is checked, and WorkError thrown if the frame does not hold it.
  SlideState state(const Frame& frame) const;
  /// Length and width between the outermost particles (with half of dp at either side) of the largest connected group:
  /// a few grains that ran ahead are not the deposit.
  SlideDeposit deposit() const;
  /// Thickness of the slide at the end by map node, m: the volume of its particles, each shared out bilinearly among
  /// the four nodes around it, over the area of a cell. Sums to the slide's volume but for what lies beyond the map's
  /// edge.
  std::vector<float> thickness() const { return thickness(header_.map); }
  std::vector<float> thickness(const SurfaceMap& map) const;  // on other nodes; local coordinates of this run
  double total_volume() const;

 private:
  bool sliding(const Frame& frame, std::size_t soil) const;  // soil particle above the threshold and not lost
  double volume_below_level(const std::vector<float>& points, std::size_t first, const uint8_t* lost) const;
  std::array<double, 3> centre(const Frame& frame) const;  // of the body, local

  const RunHeader& header_;
  Frame last_;
  double threshold_, initial_below_level_;
  std::size_t first_, n_soil_;  // in the frames
  std::vector<uint8_t> body_;   // [n_soil] part of the slide at the end
};

}  // namespace lgiw
