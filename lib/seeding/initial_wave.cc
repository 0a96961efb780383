#include "seeding/initial_wave.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hh"
#include "case/dotted_key.hh"
#include "seeding/initial_state.hh"

namespace lgiw {

namespace {

constexpr double breaking = 0.78;  // of the depth

}  // namespace

InitialWave::InitialWave(const Case& c, const TerrainModel& model, const MapCells& cells, const BedSurface& bed)
    : wave_(c.water.wave), level_(model.still_water_level), x_west_(cells.x_low) {
  if (!wave_) return;
  if (wave_->kind == WaveKind::standing) {
    number_ = wave_->mode * std::numbers::pi / (cells.x_high() - cells.x_low);
    const double deepest = level_ - bed.lowest();
    LGIW_VALIDATE(wave_->amplitude < deepest,
                  c.where("water.wave.amplitude") + ": water.wave.amplitude is " + number_text(wave_->amplitude) + " m",
                  "the water is " + number_text(deepest) + " m deep", "write less than that");
    return;
  }
  crest_ = wave_->crest - model.origin[0];
  depth_ = level_ - bed.height(crest_, cells.y(0));
  LGIW_VALIDATE(depth_ > 0, c.where("water.wave.crest") + ": water.wave.crest lies on dry land",
                "the bed there is " + number_text(-depth_) + " m above the water", "move it into the water");
  LGIW_VALIDATE(wave_->height <= breaking * depth_,
                c.where("water.wave.height") + ": water.wave.height is " + number_text(wave_->height) + " m",
                "a solitary wave over " + number_text(depth_) + " m of water breaks above " +
                    number_text(breaking * depth_) + " m",
                "write less than that");
  gamma_ = std::sqrt(3 * wave_->height / (4 * depth_));
  speed_ = (wave_->eastwards ? 1 : -1) * std::sqrt(vertical_gravity(c) / depth_);
}

double InitialWave::elevation(double x) const {
  if (!wave_) return 0;
  if (wave_->kind == WaveKind::standing) return wave_->amplitude * std::cos(number_ * (x - x_west_));
  const double sech = 1 / std::cosh(gamma_ * (x - crest_) / depth_);
  return wave_->height * sech * sech;
}

double InitialWave::highest() const { return wave_ ? std::max(wave_->height, wave_->amplitude) : 0; }

std::array<double, 3> InitialWave::velocity(double x, double z, double bed) const {
  if (!moving()) return {0, 0, 0};
  const double eta = elevation(x);
  const double slope = -2 * gamma_ / depth_ * std::tanh(gamma_ * (x - crest_) / depth_) * eta;
  return {speed_ * eta, 0, -(z - bed) * speed_ * slope};
}

double InitialWave::pressure_head(double x, double z, double bed) const {
  double eta = elevation(x);
  const double depth = level_ - bed;
  if (wave_ && wave_->kind == WaveKind::standing && z < level_ && depth > 0)
    eta *= std::cosh(number_ * (z - bed)) / std::cosh(number_ * depth);
  return std::max(0.0, level_ + eta - z);
}

}  // namespace lgiw
