// One YAML file describes a case; every tool reads it. This is the case in memory, with the defaults.
// SI units, angles in degrees, coordinates in the case's CRS (never local ones). docs/case-reference.yaml documents
// every key.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lgiw {

using Point2 = std::array<double, 2>;  // x, y; in profiles and 2-D bodies x, z

/// What lies at a side of the domain.
enum class Side { wall, absorbing, open };
/// How a wall holds soil. rough: no slip; free_slip: no shear; coulomb: friction limited.
enum class WallFriction { rough, free_slip, coulomb };
enum class PorePressure { none, hydrostatic };
enum class ConeMatching { plane_strain, plane_strain_associated, compression_cone };
enum class KernelName { wendland, cubic };
enum class Integrator { leapfrog, verlet };
enum class Precision { single_, mixed, double_ };
enum class Backend { auto_, cpu, cuda };
enum class InitialStress { k0, settled };
enum class WaveKind { solitary, standing };

struct TerrainSource {
  std::string file;           // any raster that GDAL opens; relative to the case file
  double blend = 0;           // m: width of the blended seam to the sources below; 0: four pixels of the coarser
  double vertical_shift = 0;  // m, added to the values
  std::string attribution;    // who is to be named wherever anything made from it is published; empty: nobody
  bool operator==(const TerrainSource&) const = default;
};

struct Terrain {
  std::string crs;                     // of the case; metric projected, e.g. EPSG:32611; empty: the first source's
  std::string vertical_datum;          // named, not computed with
  std::vector<TerrainSource> sources;  // coarsest first, the finer on top
  bool fill_voids = false;             // true: interpolate; false: refuse a window with voids
  double spike_threshold = 0;  // m above or below all neighbours that makes a cell a spike; 0: 3 pixels at 60 degrees
  bool remove_spikes = false;
  std::optional<std::array<double, 4>> window;  // x_min, y_min, x_max, y_max; default: see case-reference.yaml
  // Analytic terrain instead of rasters: the bed z(x) as a polyline, the same for all y.
  std::vector<Point2> profile;
  double width = 0;  // m in y, 3-D analytic scenes only; domain y from 0 to width
  // Sides: west x_min, east x_max, south y_min, north y_max.
  Side west = Side::wall, east = Side::wall, south = Side::wall, north = Side::wall;
  double absorbing_width = 0;  // m; 0: 10 dp
  double wall_top = 0;         // m: top of side walls; 0: automatic
  double reach_angle = 11;     // degrees: angle of reach (energy line) that bounds where walls are placed for soil
  double runup_allowance = 0;  // m above the still water level up to which banks get walls; 0: automatic
  bool operator==(const Terrain&) const = default;
};

/// A wave that is on the water at t = 0.
struct Wave {
  WaveKind kind = WaveKind::solitary;
  double height = 0;       // solitary: m above the still water
  double crest = 0;        // solitary: x of the crest, m
  bool eastwards = false;  // solitary: runs towards +x
  double amplitude = 0;    // standing: m
  int mode = 1;            // standing: half wave lengths over the length of the domain
  bool operator==(const Wave&) const = default;
};

struct Water {
  bool present = false;
  double level = 0;            // still water level, m
  std::optional<Point2> seed;  // a point in the reservoir; required with a DEM
  double density = 1000;
  double sound_speed = 0;  // m/s; 0: automatic
  double viscosity_alpha = 0.05;
  bool no_slip = false;            // artificial viscosity along walls, too, and not against them only
  double density_diffusion = 0.1;  // delta; 0 leaves it out
  std::vector<std::vector<Point2>>
      bodies;                // 2-D/analytic: (x, z) polygons of water instead of "everything below level"
  std::optional<Wave> wave;  // analytic scenes
};

/// How the failure surface below the ground is given; exactly one.
struct SlideSurface {
  std::string before, after;    // rasters of the ground before and after the event
  std::string thickness;        // raster of the thickness (or depth change; the absolute value counts)
  std::string failure_surface;  // raster of elevations
  std::optional<double> depth;  // m below the ground, measured vertically
  struct Plane {
    double x, y, z, dip, dip_direction;
    bool operator==(const Plane&) const = default;
  };  // through a point; degrees; direction clockwise from north
  std::optional<Plane> plane;
  std::optional<double> base_elevation;  // m: horizontal base, "soil down to a depth" as in Huang et al. 2023
  struct Slbl {
    double tolerance = 0;
    double max_depth = 0;
    double max_slope = 0;
    int neighbours = 4;
    bool operator==(const Slbl&) const = default;
  };
  std::optional<Slbl> slbl;  // sloping local base level (Jaboyedoff et al. 2004; 2019)
  bool operator==(const SlideSurface&) const = default;
};

/// The slide as a rigid body that moves as prescribed, instead of soil.
struct SlideMotion {
  std::string file;                            // CSV (lib/files/body_motion.hh), relative to the case file
  std::optional<std::array<double, 3>> pivot;  // default: the centre of its volume
  double heading = 90;                         // degrees clockwise from north: the direction in which it pitches
  bool operator==(const SlideMotion&) const = default;
};

struct Slide {
  bool present = false;
  std::vector<Point2> polygon;  // map outline; or
  std::string polygon_file;     // any vector file that OGR opens
  SlideSurface surface;
  std::vector<std::vector<Point2>> bodies;  // analytic scenes: (x, z) polygons of soil
  double min_thickness = 0;                 // m: thinner soil is left out; 0: half dp
  std::array<double, 3> velocity{0, 0, 0};  // m/s, of the soil at t = 0
  std::optional<SlideMotion> motion;        // rigid; there is no soil then
  bool operator==(const Slide&) const = default;
};

/// A rigid body of an analytic scene that moves as prescribed.
struct MovingBody {
  std::string name;
  std::vector<Point2> outline;  // x, z at t = 0; in 3-D over the whole width
  std::string motion;           // CSV (lib/files/body_motion.hh), relative to the case file
  std::optional<Point2> pivot;  // x, z; default: the centroid of the outline
  bool operator==(const MovingBody&) const = default;
};

/// mu(I): strength that grows with the shear rate, up to that of friction_angle_fast.
struct SoilRate {
  bool present = false;
  double friction_angle_fast = 0;  // degrees
  double inertial_number = 0.279;  // I_0, at which half of the growth is reached
  double grain_diameter = 0;       // m
  double grain_density = 2650;     // of the grains themselves, kg/m3
};

struct Soil {
  double density = 2000;       // bulk, including pore water, kg/m3
  double friction_angle = 30;  // degrees
  double cohesion = 0;         // Pa
  double dilatancy_angle = 0;  // degrees
  double young_modulus = 5e7;  // Pa
  double poisson_ratio = 0.3;
  double viscosity_alpha = 0;     // 0: automatic, alpha c_s = 3 sqrt(g H) with H the soil's height
  double stress_diffusion = 0.1;  // 0 leaves it out
  double artificial_stress = 0;   // epsilon of Eq. (7); 0 leaves it out
  ConeMatching cone = ConeMatching::plane_strain;
  PorePressure pore_pressure = PorePressure::hydrostatic;  // meaningless without water
  WallFriction bed = WallFriction::rough;
  WallFriction sides = WallFriction::free_slip;
  double bed_friction_angle = 0;  // degrees, with bed: coulomb
  InitialStress initial_stress = InitialStress::k0;
  SoilRate rate;
};

struct Interface {
  bool repulsion = true;
  double velocity_factor = 1;  // xi of physics.md section 7; 2 is the paper's mirrored velocity
};

struct Numerics {
  std::string scheme = "lgiw";  // lgiw | huang2023: sets the defaults of the keys below
  KernelName kernel = KernelName::wendland;
  double h_over_dp = 1.5;
  Integrator integrator = Integrator::leapfrog;
  double cfl = 0.6;
  int retakes = 3;             // of a stretch whose last step failed, each with half the time step of the one before
  bool return_mapping = true;  // false: rate form, Eqs. (8)-(9)
  bool wall_viscosity = true;  // Pi_ib of physics.md section 8
  bool corrected_strain_rate = false;  // first-order velocity gradient of the soil
  double shifting = 0;                 // of water, A of Skillen et al. 2013; 0 leaves it out
  Precision precision = Precision::mixed;
  double settle_time = 0;  // s of damped motion before t = 0; the soil is held unless its initial stress is to settle
  Backend backend = Backend::auto_;
  int threads = 0;  // 0: all
};

struct Output {
  double end_time = 60;              // s
  double frame_interval = 1;         // s, particle frames
  double surface_interval = 0;       // s, surface rasters and maxima; 0: 0.3 sqrt(dp / g)
  double map_spacing = 0;            // m, cell of the surface rasters; 0: dp
  double arrival_threshold = 0;      // m; 0: a quarter of dp
  double checkpoint_interval = 600;  // s of wall-clock time
};

enum class GaugeQuantity { surface, pressure };
struct Gauge {
  std::string name;
  double x = 0, y = 0;
  GaugeQuantity quantity = GaugeQuantity::surface;
  double z = 0;  // m, elevation; of a pressure gauge
};
struct Section {
  std::string name;
  std::vector<Point2> points;
};  // polyline from the slide to the opposite bank

struct Deposit {
  double adps_threshold = 0.2;
};

struct Case {
  std::string name;
  int dimension = 3;  // 2: plane strain in (x, z)
  double dp = 0;      // particle spacing, m
  std::array<double, 3> gravity{0, 0, -9.81};
  Terrain terrain;
  Water water;
  Slide slide;
  std::vector<MovingBody> bodies;
  Soil soil;
  Interface interface;
  Numerics numerics;
  Output output;
  std::vector<Gauge> gauges;
  std::vector<Section> sections;
  Deposit deposit;

  std::string text;  // the YAML as read; with overrides, a YAML that holds them and reads the same
  std::string path;  // where it was read, "-" for stdin, "" for text
  bool has_soil() const { return slide.present && !slide.motion; }
  std::string folder() const;  // against which file names in it are resolved
  std::string resolve(const std::string& file) const;
  /// "file:line" (or the --set) of a dotted key such as "water.seed" or "gauges.0", of its nearest parent where it is
  /// not given: what an error found later, against the DEM, begins with.
  std::string where(const std::string& key) const;
  std::map<std::string, std::string> places;  // of all keys that are given; "" is the document
};

/// Reads and validates a case. `path` "-" is stdin. Throws InputError with `path:line:` in front for syntax, unknown
/// keys (naming the nearest known one), values out of the range of their unit, and impossible combinations. Opens no
/// other file. `overrides` are `key.sub=value` strings from --set, applied before validation: the value is YAML, list
/// items are named by number from 0 (`gauges.0.x=12`), `list+=item` adds one, and `null` removes a key or section.
Case read_case(const std::string& path, const std::vector<std::string>& overrides = {});
Case parse_case(const std::string& text, const std::string& name_for_messages,
                const std::vector<std::string>& overrides = {});

/// Every key that a case may have, dotted and without list numbers: "name", "water", "water.level", "gauges.x" ...
std::vector<std::string> known_case_keys();

/// The files that a case names, as they stand in it.
std::vector<std::string> files_of(const Case& c);

/// The first key of those that particles are made from - spacing, terrain, water, slide, bodies and what their initial
/// pressure and stress follow from - in which two cases differ; empty where they agree. Files count by their names
/// alone: a case may have moved. The friction angle and the pore pressure, which only the horizontal K0 stress follows
/// from, may differ: the first steps yield.
std::string differing_geometry(const Case& a, const Case& b);

/// What is allowed but rarely meant, one line each, for stderr.
std::vector<std::string> case_warnings(const Case& c);

}  // namespace lgiw
