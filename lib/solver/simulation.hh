// A running simulation behind one interface; the backend and the compiled kernels are chosen when it is made.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "solver/setup.hh"

namespace lgiw {

enum class NumberType { single_, mixed, double_ };

/// Damped motion before t = 0. water: the soil is held while the water finds its place; all: the soil, too, comes to
/// rest under its weight, elastically, so that its stress is in balance whatever its shape.
enum class Settling { off, water, all };

/// Where the time stepping stands. Kept on the device; copied to the host when asked for.
struct StepState {
  double time = 0, target = 0;     // s; steps are taken while time < target
  double dt = 0, dt_previous = 0;  // s
  double share = 1;                // of the CFL number that steps take; less while a failed stretch is retaken
  int64_t step = 0;
  int32_t euler_countdown = 0;  // Verlet: steps left until the next Euler step
  int32_t settling = 0;         // Settling
  int32_t limit = 0;            // what limited dt: 0 acoustic, 1 force, 2 viscous, 3 diffusive
  int32_t stopped = 0;          // 1: a step has failed, and what is still queued changes nothing
  double smallest_dt = 1e300;   // s, of the steps taken
  int64_t limited[4] = {};      // steps taken, by what limited them
  int32_t lost_water = 0, lost_soil = 0;
  uint32_t failed_water = UINT32_MAX,
           failed_soil = UINT32_MAX;  // smallest id in a state that is not finite or out of range
};

/// The moving particles in the order of the particles file (by id).
struct ParticleState {
  std::vector<double> water_x, soil_x;              // [n,3]; y = 0 in 2-D
  std::vector<float> water_v, soil_v;               // [n,3]
  std::vector<float> water_pressure, water_excess;  // [n]
  std::vector<float> soil_stress, soil_adps;        // [n,6], [n]
  std::vector<unsigned char> water_lost, soil_lost;
};

/// Forces of the moving particles on themselves and on each other, walls, gravity and absorbing sides left out, N.
struct InternalForces {
  std::array<double, 3> net{};  // 0 where action equals reaction
  double sum = 0;               // of the magnitudes
};

/// One array of the restart state, as raw bytes.
struct RawArray {
  std::string name;
  std::vector<unsigned char> bytes;
};

struct PhaseTime {
  std::string name;
  double seconds;
};

/// Memory by phase, each with its cells.
struct PhaseBytes {
  int64_t water = 0, soil = 0, wall = 0;  // wall: moving bodies too
  int64_t shared = 0;                     // by the phases, which are sorted in turn
  int64_t total() const { return water + soil + wall + shared; }
};

class Simulation {
 public:
  virtual ~Simulation() = default;
  /// Steps until time >= target or `max_steps` are done; returns the state then. Stops early on a failed particle.
  virtual StepState advance(double target, int64_t max_steps) = 0;
  virtual StepState state() const = 0;
  /// From the coming step on, steps take this share of the CFL number; in (0, 1].
  virtual void limit_time_step(double share) = 0;
  /// Begins or ends settling: velocities and time are reset to zero.
  virtual void settle(Settling mode) = 0;
  virtual void download(ParticleState& out) const = 0;
  /// The same in two parts: what the solver must stand still for, and the function returned, which is left to do until
  /// `out` holds the state, whatever the solver does meanwhile. It comes before the next call.
  virtual std::function<void()> begin_download(ParticleState& out) const {
    download(out);
    return [] {};
  }
  /// Pressure (Pa) and, with soil, the image stress at the wall particles, in the order of the particles file.
  virtual void download_walls(std::vector<float>& pressure, std::vector<float>& stress) const = 0;
  /// Where the wall particles of moving bodies are, [n,3], and their indices among the wall particles, [n].
  virtual void download_bodies(std::vector<double>& x, std::vector<unsigned>& wall_id) const = 0;
  /// Forces now acting on the particles, by id: mass times acceleration without gravity, N; [n,3]. 0 on lost ones.
  virtual void download_accelerations(std::vector<double>& water, std::vector<double>& soil) const = 0;
  /// Computes the forces of the present state once more, without walls; the state stays as it is.
  virtual InternalForces internal_forces() = 0;
  virtual std::vector<RawArray> save() const = 0;
  virtual void restore(const std::vector<RawArray>& arrays) = 0;  // throws InputError when they do not fit
  virtual std::vector<PhaseTime> timings() const = 0;
  virtual PhaseBytes bytes() const = 0;         // held for particles and neighbours
  virtual std::string description() const = 0;  // backend, precision, kernel
  virtual std::string device() const = 0;       // what it runs on
  /// Whether another thread of the host can do something else while it steps.
  virtual bool leaves_host_free() const = 0;
  /// What this scene does not need and therefore neither holds nor runs, with the bytes saved.
  virtual std::vector<std::string> left_out() const = 0;
};

/// With the widest instructions of the processor, or those that the environment variable LGIW_INSTRUCTIONS names.
std::unique_ptr<Simulation> make_cpu_simulation(const ModelParameters& p, const InitialParticles& particles,
                                                NumberType type);
/// Names of the instruction sets that both the build and the processor have, for LGIW_INSTRUCTIONS.
std::vector<std::string> cpu_instruction_sets();
/// Throws BackendError when there is no CUDA device (or no driver, or no CUDA in this build).
std::unique_ptr<Simulation> make_cuda_simulation(const ModelParameters& p, const InitialParticles& particles,
                                                 NumberType type);
/// Whether a CUDA device answers; `why` tells what is missing otherwise.
bool cuda_available(std::string* why = nullptr);

}  // namespace lgiw
