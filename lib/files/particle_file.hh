// The particles file: what dem2particles writes and lgiw-run reads.
//
// VTKHDF PolyData, one step, particles ordered water, soil, wall. /VTKHDF/Points float64 [N,3] in local coordinates,
// PointData: Phase uint8 (0 water, 1 soil, 2 wall), Volume float32, Density float32, Pressure float32.
// Outside /VTKHDF, group /lgiw (readers of VTKHDF ignore it):
//   attributes: Format = "lgiw-particles 1", Dimension, ParticleSpacing, Origin [3] (add to local coordinates to get the
//     case's CRS), CRS (WKT, "" for analytic scenes), VerticalDatum, Attribution (whom to name for
//     the terrain; absent in older files), StillWaterLevel (local z; NaN without water),
//     DomainLow [3], DomainHigh [3] (local; a particle outside has left), Sides [4] (west, east, south, north as Side),
//     AbsorbingWidth, SoundSpeed (of the water, m/s; 0 without water), Counts [3] (int64: water, soil, wall), WallLeftOut,
//     Case (YAML text), Provenance (JSON),
//     LeftOut (JSON: what was left out and how much)
//   /lgiw/soil/Stress float32 [n_soil,6]: xx yy zz xy yz xz, tension positive, total
//   /lgiw/wall/Normal float32 [n_wall,3] into the domain;  /lgiw/wall/Kind uint8: 0 bed, 1 side, 2 rigid body
//   /lgiw/bodies/1, 2, ... rigid bodies that move as prescribed (BodyMotion): attributes Name, Pivot [3], Heading; Time
//     and Pitch float64 [rows], Displacement float64 [rows,3]
//   /lgiw/wall/Body uint8 [n_wall], where there are bodies: the number of the body that a particle moves with, 0: none
//   /lgiw/bed, /lgiw/ground: float64 [ny,nx] with attributes x0, y0, dx (HeightField); ground: before the slide, soil on it
// PointData/Velocity float32 [N,3], m/s at t = 0, only where something moves then; that of wall particles is 0.
// A dataset of a phase that the scene lacks is absent, and so is an empty bed or ground.
// Vertices hold one cell a particle, so that filters can pick particles by phase; their topology is deflated.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hh"
#include "files/body_motion.hh"
#include "files/h5.hh"
#include "files/height_field.hh"

namespace lgiw {

enum class Phase : uint8_t { water = 0, soil = 1, wall = 2 };

struct ParticleCounts {
  int64_t water = 0, soil = 0, wall = 0;
  int64_t wall_left_out = 0;   // wall particles not placed since nothing can reach them
  int64_t total() const { return water + soil + wall; }
};

/// Everything of a particles file but the particles.
struct ParticleHeader {
  int dimension = 3;
  double dp = 0;
  std::array<double, 3> origin{0, 0, 0};
  std::string crs_wkt, vertical_datum;
  std::string attribution;             // who is to be named for the terrain; "" where the case names nobody
  double still_water_level = 0;        // local; NaN without water
  std::array<double, 3> low{}, high{}; // local domain box
  std::array<Side, 4> sides{Side::wall, Side::wall, Side::wall, Side::wall};
  double absorbing_width = 0;
  double sound_speed = 0;              // of the water, m/s; 0 without water
  HeightField bed, ground;
  std::vector<BodyMotion> bodies;      // wall particles of kind 2 move with them; at most 255
  bool initial_velocity = false;       // something moves at t = 0; told by PointData/Velocity, not kept in run files
  std::string case_text, provenance;
  ParticleCounts counts;
};

/// A run of particles of one phase, to be appended.
struct ParticleBlock {
  Phase phase = Phase::water;
  std::vector<double> points;          // [n,3] local
  std::vector<float> volume, density, pressure;
  std::vector<float> stress;           // soil: [n,6]
  std::vector<float> normal;           // wall: [n,3]
  std::vector<uint8_t> kind;           // wall: [n]; 0 bed, 1 side, 2 surface or inside of a moving body
  std::vector<float> velocity{};       // water, soil: [n,3] m/s at t = 0; empty: at rest
  std::vector<uint8_t> body{};         // wall: [n]; 0 fixed, k moves with header.bodies[k - 1]; empty: all fixed
  std::size_t size() const { return volume.size(); }
};

/// Streams a particles file; counts must be known beforehand, and blocks of one phase may come in any number of pieces, the
/// phases interleaved as they come. Takes no memory of its own beyond a few MiB. Throws InputError when the header is unsound
/// (what read_particle_header() would refuse), WorkError when blocks and counts disagree or the disk is full.
class ParticleWriter {
 public:
  ParticleWriter(const std::string& path, const ParticleHeader& header);  // header.counts fixes the sizes
  void append(const ParticleBlock& block);
  void finish();                       // topology, checks that all counts were met, closes

 private:
  h5::File file_;
  ParticleHeader header_;
  std::array<int64_t, 3> written_{0, 0, 0};
};

struct ParticleData {
  ParticleHeader header;
  ParticleBlock water, soil, wall;
};

/// Reads a whole file. Throws InputError for anything that is not a sound particles file: wrong format, sizes that do not
/// agree or exceed the file, non-finite values, volumes or densities that are not positive, wall normals that are not unit
/// vectors, water or soil outside the domain box (walls may lie outside, behind the sides), walls of bodies that are not
/// in the header. Of a phase that is at rest `velocity` stays empty, `body` without bodies.
ParticleData read_particles(const std::string& path);
ParticleHeader read_particle_header(const std::string& path);

}  // namespace lgiw
