#include "solver/runner.hh"

#include <fcntl.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/atomic_file.hh"
#include "base/error.hh"
#include "base/ordered_blocks.hh"
#include "base/provenance.hh"
#include "files/run_file.hh"
#include "measure/column_surface.hh"
#include "physics/soil.hh"
#include "seeding/run_estimate.hh"
#include "solver/checkpoint.hh"
#include "solver/diagnostics.hh"
#include "solver/envelope.hh"
#include "solver/error_budget.hh"
#include "solver/make_setup.hh"
#include "solver/neighbour_count.hh"
#include "solver/output_plan.hh"
#include "solver/water_pressure.hh"

namespace lgiw {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t caught_signal = 0;
void on_signal(int s) { caught_signal = s; }

/// Catches SIGINT, SIGTERM and SIGHUP (the terminal is gone) while it lives; the last not where nohup has it ignored. A
/// closed pipe behind the log ends no run.
class SignalGuard {
 public:
  SignalGuard() {
    caught_signal = 0;
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, &old_int_);
    sigaction(SIGTERM, &action, &old_term_);
    sigaction(SIGHUP, &action, &old_hangup_);
    if (old_hangup_.sa_handler == SIG_IGN) sigaction(SIGHUP, &old_hangup_, nullptr);
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, &old_pipe_);
  }
  ~SignalGuard() {
    sigaction(SIGINT, &old_int_, nullptr);
    sigaction(SIGTERM, &old_term_, nullptr);
    sigaction(SIGHUP, &old_hangup_, nullptr);
    sigaction(SIGPIPE, &old_pipe_, nullptr);
  }

 private:
  struct sigaction old_int_ {
  }, old_term_{}, old_hangup_{}, old_pipe_{};
};

constexpr const char* limit_names[] = {"acoustic", "force", "viscous", "diffusive"};
const char* limit_name(int limit) { return limit_names[limit]; }

const char* precision_name(Precision p) {
  return p == Precision::single_ ? "single" : (p == Precision::double_ ? "double" : "mixed");
}

/// Largest memory that this process has held so far (VmHWM), bytes; 0 where the system does not tell.
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.compare(0, 6, "VmHWM:") == 0) return 1024 * std::atof(line.c_str() + 6);
  return 0;
}

std::unique_ptr<Simulation> make_simulation(const Case& c, const ModelParameters& model, const InitialParticles& in,
                                            const std::function<void(const std::string&)>& log) {
  const NumberType type = number_type(c.numerics.precision);
  std::string why;
  switch (c.numerics.backend) {
    case Backend::cuda:
      return make_cuda_simulation(model, in, type);
    case Backend::auto_:
      if (cuda_available(&why)) return make_cuda_simulation(model, in, type);
      if (log) log("no CUDA device (" + why + "): running on the CPU");
      break;
    default:
      break;
  }
  return make_cpu_simulation(model, in, type);
}

/// What a run is warned of beforehand: its resolution first, then where it is outside of the envelope.
std::vector<std::string> warnings_beforehand(const Resolution& resolution, const std::vector<std::string>& outside) {
  std::vector<std::string> warnings = warnings_of(resolution);
  warnings.insert(warnings.end(), outside.begin(), outside.end());
  return warnings;
}

double moving_bytes(const Simulation& s) {
  const PhaseBytes bytes = s.bytes();
  return double(bytes.water + bytes.soil);
}

/// Blocks as large as an output's arrays and chunks go back to the system when they are freed. Otherwise the C library
/// learns to keep them, and whatever small outlives them lies between: in a run of 1040 outputs that took a sixth more
/// memory in the end.
void give_back_large_blocks() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 18);
#endif
}

/// One list after the other, by all threads.
template <class From, class To>
void join(const std::vector<From>& first, const std::vector<From>& second, std::vector<To>& both) {
  both.resize(first.size() + second.size());
#pragma omp parallel for schedule(static) if (both.size() > too_few_to_share)
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = To(i < first.size() ? first[i] : second[i - first.size()]);
}

class Runner {
 public:
  Runner(const Case& c, const ParticleData& data, const RunOptions& options)
      : case_(c),
        data_(data),
        header_(data.header),
        options_(options),
        model_(make_model(c, data)),
        map_(output_map(c, data.header)),
        surface_map_(map_, header_.bed),
        schedule_(output_schedule(c, header_.dp)) {
    arrival_threshold_ = c.output.arrival_threshold > 0 ? c.output.arrival_threshold : header_.dp / 4;
    place_pressure_gauges();
    LGIW_VALIDATE(!h5::is_being_written(partial_path(options.output)), options.output + " is being written",
                  "another lgiw-run has " + partial_path(options.output) + " open",
                  "wait for it or stop it, or choose another name");
    identity_ = identity(data);
    if (options.resume)
      resumed_ = read_newest_checkpoint(checkpoint_path(options.output), identity_, &resume_note_);
    else
      refuse_unfinished();
    initial_soil_.assign(data.soil.points.begin(), data.soil.points.end());
    simulation_ = make_simulation(c, model_, make_particles(c, data), options.log);
    if (options.wrap) simulation_ = options.wrap(std::move(simulation_));
    log("model: " + simulation_->description());
    describe();
    for (const std::string& line : simulation_->left_out()) log("left out: " + line);
    resolution_ = resolution_of(c, data);
    log(text_of(resolution_));
    outside_ = warnings_of(envelope_of(c, model_));
    warnings_ = warnings_beforehand(resolution_, outside_);
    for (const std::string& warning : warnings_) log("warning: " + warning);
    warn_of_space();
  }
  ~Runner() {
    if (output_being_made_.valid()) output_being_made_.wait();
    omp_set_num_threads(threads_);
  }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  std::string run() {
    SignalGuard guard;
    set_up_seconds_ = elapsed();
    start_ = Clock::now();
    if (options_.resume)
      resume();
    else
      open();
    checkpoint_at_ = elapsed() + case_.output.checkpoint_interval;
    keep();
    if (outputs_ == 0) {
      settle();
      kept_.clear();  // of settling
      record();
      keep();
    }
    while (outputs_ <= schedule_.last) {
      checkpoint_if_due();
      if (!advance_to(outputs_ < schedule_.last ? double(outputs_) * schedule_.interval : case_.output.end_time))
        continue;
      record();
      return_to_usual_step();
      keep();
    }
    return finish();
  }

 private:
  /// Not kept with the results: another machine has another disk. What an earlier start of this run has written is
  /// gone on with or removed: it takes up room that this one has.
  void warn_of_space() const {
    const fs::path folder = fs::absolute(options_.output).parent_path();
    std::error_code unknown;
    const fs::space_info space = fs::space(folder, unknown);
    if (unknown) return;
    double available = double(space.available);
    std::vector<std::string> own = checkpoints();
    own.push_back(partial_path(options_.output));
    for (const std::string& path : own) {
      const auto bytes = fs::file_size(path, unknown);
      if (!unknown) available += double(bytes);
    }
    const OutputSize size = output_size(case_, header_, moving_bytes(*simulation_));
    const std::string warning = space_warning(size, available, folder.string());
    if (!warning.empty()) log("warning: " + warning);
  }
  void log(const std::string& line) const {
    if (options_.log) options_.log(line);
  }
  void place_pressure_gauges() {
    for (const Gauge& gauge : case_.gauges) {
      if (gauge.quantity != GaugeQuantity::pressure) continue;
      const std::array<double, 3> at{gauge.x - header_.origin[0],
                                     header_.dimension == 3 ? gauge.y - header_.origin[1] : 0.0,
                                     gauge.z - header_.origin[2]};
      LGIW_VALIDATE(at[2] >= header_.low[2] && at[2] <= header_.high[2],
                    "pressure gauge " + gauge.name + " lies outside the domain",
                    "its z of " + std::to_string(gauge.z) + " m is not between " +
                        std::to_string(header_.low[2] + header_.origin[2]) + " and " +
                        std::to_string(header_.high[2] + header_.origin[2]) + " m",
                    "move it");
      gauge_names_.push_back(gauge.name);
      gauge_points_.push_back(at);
    }
  }
  /// A new run would discard the checkpoint of another.
  void refuse_unfinished() const {
    const std::string path = checkpoint_path(options_.output);
    LGIW_VALIDATE(options_.overwrite || !fs::exists(path), path + " exists",
                  "it is the state of an unfinished run, which a new one would discard",
                  "go on with --resume, or start anew with -O");
  }
  double elapsed() const { return earlier_ + std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// What must not change between a run and its resumption.
  std::string identity(const ParticleData& data) const {
    const auto hash = [](const auto& v) {
      return sha256_of_text(std::string(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(v[0])));
    };
    std::ostringstream s;
    s << case_.text << '\n'
      << header_.case_text << '\n'
      << int(case_.numerics.precision) << ' ' << header_.sound_speed << hash(data.water.points)
      << hash(data.water.pressure) << hash(data.soil.points) << hash(data.soil.stress) << hash(data.wall.points)
      << hash(data.wall.volume) << hash(data.wall.normal) << hash(data.wall.kind) << hash(data.wall.body)
      << hash(data.water.velocity) << hash(data.soil.velocity);
    for (const BodyMotion& m : header_.bodies)
      s << hash(m.pivot) << m.heading << hash(m.time) << hash(m.pitch) << hash(m.displacement);
    return sha256_of_text(s.str());
  }

  void describe() const {
    std::ostringstream s;
    s.precision(4);
    const StepState st = simulation_->state();
    s << "particles: " << header_.counts.water << " water, " << header_.counts.soil << " soil, " << header_.counts.wall
      << " wall (" << header_.counts.wall_left_out << " wall particles left out); "
      << simulation_->bytes().total() / double(1 << 20) << " MiB; ";
    if (header_.counts.water) s << "water c " << model_.sound_speed << " m/s; ";
    if (header_.counts.soil)
      s << "soil c "
        << SoilMaterial<double>::wave_speed(model_.young_modulus, model_.poisson_ratio, model_.soil_density)
        << " m/s, alpha " << model_.soil_alpha << "; ";
    s << "first time step " << st.dt << " s, limited by the " << limit_name(st.limit) << " condition";
    log(s.str());
  }

  /// Of runs of this name that were killed while they wrote; beside the partial run and the checkpoints no use any
  /// more.
  void remove_leftovers() const {
    remove_abandoned(checkpoint_path(options_.output));
    remove_abandoned(partial_path(options_.output));
    remove_abandoned(options_.output);
  }

  void open() {
    remove_leftovers();
    for (const std::string& path : checkpoints()) fs::remove(path);  // of an earlier run: no state of this one
    RunHeader h;
    h.particles = header_;
    h.particles.case_text = case_.text;
    h.particles.provenance = options_.provenance ? options_.provenance_json : "{}";
    h.particle_volume = std::pow(header_.dp, header_.dimension);
    h.left_out = nlohmann::json(simulation_->left_out()).dump();
    h.map = map_;
    h.initial_soil = initial_soil_;
    h.pressure_gauges = gauge_names_;
    writer_ = std::make_unique<RunWriter>(partial_path(options_.output), h);
  }

  /// Lets the water find its place beside walls and soil, and the soil its stress where the case asks for it, before t
  /// = 0.
  void settle() {
    const double duration = model_.settle_time;
    if (!(duration > 0) || !(header_.counts.water || model_.settle_soil)) return;
    do {
      // Set in a resumed run; not in what was kept before the start, to which a failed step leads back.
      if (!simulation_->state().settling) simulation_->settle(model_.settle_soil ? Settling::all : Settling::water);
    } while (!advance_to(duration));
    const StepState st = simulation_->state();
    extremes_["settle_steps"] = double(st.step);
    ParticleState s;
    simulation_->download(s);
    const auto rows = diagnose(model_, s, st, header_.bed);
    std::ostringstream line;
    line << "settled for " << duration << " s in " << st.step << " steps";
    for (const auto& [name, value] : rows)
      if (name == "max_water_speed" || (name == "max_soil_speed" && model_.settle_soil))
        line << "; fastest " << (name == "max_water_speed" ? "water" : "soil") << " before the start " << value
             << " m/s";
    log(line.str());
    simulation_->settle(Settling::off);
    // Its clock was another, and what failed was not the run.
    simulation_->limit_time_step(1);
    retaken_.tries = 0, retaken_.until = 0;
  }

  /// Steps until the time is `target`, with checkpoints by the clock and on a signal. False where a step failed and the
  /// run has gone back to an earlier state, to be taken again.
  bool advance_to(double target) {
    StepState st = simulation_->state();
    while (st.time < target) {
      const int64_t before = st.step;
      const double since = elapsed();
      const bool shared = shares_threads();
      st = simulation_->advance(target, shared ? 1 : batch_);
      const double seconds = elapsed() - since;
      steps_taken_ += st.step - before, seconds_taken_ += seconds;
      if (!shared && st.step > before) step_seconds_ = seconds / double(st.step - before);
      if (failed(st)) {
        go_back(st);
        return false;
      }
      // As many steps at a stroke as keep signals and progress prompt.
      if (!shared && seconds < 0.1)
        batch_ = std::min<int64_t>(2 * batch_, 1000);
      else if (!shared && seconds > 0.4)
        batch_ = std::max<int64_t>(batch_ / 2, 1);
      progress(st);
      if (st.time < target) checkpoint_if_due();
    }
    return true;
  }

  /// By the clock, and on a signal. Not between the last step to an output time and record(): it looks at what that
  /// step left in arrays that no checkpoint holds.
  void checkpoint_if_due() {
    if (caught_signal) {
      checkpoint();
      throw Interrupted{caught_signal};
    }
    if (elapsed() > checkpoint_at_) {
      checkpoint();
      checkpoint_at_ = elapsed() + case_.output.checkpoint_interval;
    }
  }

  static bool failed(const StepState& st) { return st.failed_water != UINT32_MAX || st.failed_soil != UINT32_MAX; }

  /// Keeps the present state in memory every so often, and one before it: what led to a failure may have begun before
  /// the last.
  void keep() {
    if (case_.numerics.retakes == 0) return;
    const int64_t step = simulation_->state().step;
    if (!kept_.empty() && step < kept_.back().step + steps_between_kept) return;
    wait_for_output();
    if (kept_.size() == 2) kept_.erase(kept_.begin());
    kept_.push_back({step, present()});
  }

  /// Takes the stretch before a failed step again with half the time step, then from further back with a quarter, and
  /// so on; throws when that was in vain. The smaller step lasts until as much time has passed beyond the failure as
  /// lay before it.
  void go_back(const StepState& at) {
    wait_for_output();
    const bool again = retaken_.tries > 0;
    if (again ? retaken_.tries == case_.numerics.retakes : kept_.empty() || retaken_.failures == most_failures)
      give_up(at);
    if (!again) ++retaken_.failures;
    ++retaken_.tries;
    if (retaken_.tries > 1) kept_.resize(1);
    const Checkpoint& kept = kept_.back().state;
    restore_state(kept);
    const StepState st = simulation_->state();
    const double share = std::pow(0.5, retaken_.tries);
    simulation_->limit_time_step(share);
    retaken_.until = std::max(retaken_.until, at.time + (at.time - st.time));
    char line[200];
    std::snprintf(line, sizeof line,
                  "a step failed at t = %.4g s (step %lld): taken again from t = %.4g s with 1/%d of the time step",
                  at.time, static_cast<long long>(at.step), st.time, 1 << retaken_.tries);
    log(line);
    retakes_.push_back(line);
    if (!writer_ || writer_->surfaces() == kept.surfaces) return;  // nothing was written since
    // The checkpoints there are may count on what the run file is about to lose.
    flush();
    Checkpoint c = present();
    c.frames = kept.frames, c.surfaces = kept.surfaces, c.diagnostics = kept.diagnostics;
    write_checkpoint(checkpoint_path(options_.output), c);
    std::error_code none;
    fs::remove(previous_checkpoint(checkpoint_path(options_.output)), none);
    shorten_run_file(kept);
  }

  /// At the times of outputs only, which do not depend on how fast the machine is.
  void return_to_usual_step() {
    const StepState st = simulation_->state();
    if (st.share == 1 || st.time <= retaken_.until) return;
    simulation_->limit_time_step(1);
    retaken_.tries = 0;
  }

  void give_up(const StepState& st) {
    const bool water = st.failed_water != UINT32_MAX;
    flush();
    ParticleState s;
    simulation_->download(s);
    const uint32_t id = water ? st.failed_water : st.failed_soil;
    const auto& x = water ? s.water_x : s.soil_x;
    const auto& v = water ? s.water_v : s.soil_v;
    std::ostringstream what, why, then;
    what << "the run diverged at t = " << st.time << " s, step " << st.step;
    why << (water ? "water" : "soil") << " particle " << id << " at x " << x[3 * id] + header_.origin[0] << ", y "
        << x[3 * id + 1] + header_.origin[1] << ", z " << x[3 * id + 2] + header_.origin[2] << " has velocity ("
        << v[3 * id] << ", " << v[3 * id + 1] << ", " << v[3 * id + 2] << ") m/s";
    if (water) why << " and density " << model_.water_density + s.water_excess[id] << " kg/m3";
    why << ": not finite or out of range";
    if (retaken_.tries > 0) why << ", also with 1/" << (1 << retaken_.tries) << " of the time step";
    if (fs::exists(checkpoint_path(options_.output)))
      then << "the last good state is " << checkpoint_path(options_.output) << "; ";
    then << "frames up to the failure are in " << partial_path(options_.output) << "; "
         << (outside_.empty() ? "try a smaller numerics.cfl or a larger water.sound_speed" : outside_.front());
    throw WorkError(what.str(), why.str(), then.str());
  }

  void progress(const StepState& st) const {
    if (!options_.progress) return;
    const double rate = double(steps_taken_) * double(header_.counts.total()) / std::max(seconds_taken_, 1e-9);
    char note[160];
    std::snprintf(note, sizeof note, "%s %.2f s, dt %.3g s (%s), %.2f M particle-steps/s",
                  st.settling ? "settling" : "t", st.time, st.dt, limit_name(st.limit), rate / 1e6);
    options_.progress(st.settling ? 0 : std::min(1.0, st.time / case_.output.end_time), note);
  }

  /// Surface rasters, maxima and diagnostics of the present state, and every so often a frame. The solver steps on
  /// while they are made, on a CPU with the threads that are left: most of an output is one after the other.
  void record() {
    wait_for_output();
    output_.bring = simulation_->begin_download(output_.state);
    output_.at = simulation_->state();
    output_.with_frame = schedule_.with_frame(outputs_);
    // Costs half a step, in whose phases it is counted, and changes slowly.
    const bool measured = outputs_ == 0 || outputs_ == schedule_.last ||
                          (output_.with_frame &&
                           double(output_.at.step) >= extremes_["momentum_residual_step"] + steps_between_residuals);
    if (measured) extremes_["momentum_residual_step"] = double(output_.at.step);
    output_.momentum_residual = measured ? momentum_residual() : extremes_["last_momentum_residual"];
    ++outputs_;
    if (simulation_->leaves_host_free()) return make_output_beside(threads_);
    const int for_output = std::max(1, threads_ / 8), for_steps = threads_ - for_output;
    // A step that has begun with fewer threads ends with them, however soon the output is done. Where that takes longer
    // than half of an output, all threads make it between two steps.
    if (for_steps == 0 || step_seconds_ * for_output / for_steps > 0.5 * output_seconds_) return make_output();
    make_output_beside(for_output);
    omp_set_num_threads(for_steps);
  }
  void make_output_beside(int threads) {
    output_being_made_ = std::async(std::launch::async, [this, threads] {
      omp_set_num_threads(threads);
      make_output();
    });
  }
  /// Before anything that an output makes is looked at or changed: the run file, maxima and extremes. Throws what went
  /// wrong with it.
  void wait_for_output() {
    if (!output_being_made_.valid()) return;
    output_being_made_.wait();
    omp_set_num_threads(threads_);
    output_being_made_.get();
  }
  /// Whether the solver has fewer threads for it. Gives them back when the output is done.
  bool shares_threads() {
    if (omp_get_max_threads() == threads_) return false;
    if (output_being_made_.valid() && output_being_made_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      return true;
    omp_set_num_threads(threads_);
    return false;
  }
  void make_output() {
    const double begin = elapsed();
    write_output();
    output_seconds_ = elapsed() - begin;
  }
  void write_output() {
    output_.bring();
    ParticleState& s = output_.state;
    const StepState& st = output_.at;
    Frame& frame = output_.frame;
    frame.time = st.time;
    join(s.water_x, s.soil_x, frame.points), join(s.water_v, s.soil_v, frame.velocity);
    join(s.water_lost, s.soil_lost, frame.lost);
    const std::size_t nw = s.water_x.size() / 3, ns = s.soil_x.size() / 3;

    const ColumnSurfaces& surfaces = surface_map_(column_particles(header_, frame));
    static const std::vector<float> none;
    writer_->add_surface(st.time, nw ? surfaces.water : none, surfaces.soil, water_pressures(model_, s, gauge_points_));
    accumulate(surfaces, st.time, nw > 0, ns > 0);

    const double since = elapsed();
    DiagnosticsRow row = diagnose(model_, s, st, header_.bed);
    row.emplace_back("momentum_residual", output_.momentum_residual);
    writer_->add_diagnostics(st.time, row);
    lgiw::accumulate(row, extremes_);
    refuse_compressed(row, st.time);
    diagnostics_seconds_ += elapsed() - since;

    if (!output_.with_frame) return;
    if (nw) {
      frame.pressure = s.water_pressure;
      frame.pressure.resize(nw + ns, 0.f);
    }
    if (ns) {
      frame.adps.assign(nw, 0.f);
      frame.adps.insert(frame.adps.end(), s.soil_adps.begin(), s.soil_adps.end());
    }
    writer_->add_frame(frame);
  }

  /// Water that is no longer nearly incompressible gives smooth, wrong waves.
  void refuse_compressed(const DiagnosticsRow& row, double time) {
    const auto value = [&](const char* name) {
      for (const auto& [key, v] : row)
        if (key == name) return v;
      return 0.0;
    };
    const double error = value("density_error_p999");
    if (!(error > stop_at::density_error)) return;
    flush();
    std::ostringstream what, why, then;
    what.precision(3), why.precision(3), then.precision(3);
    what << "the water is compressed by " << 100 * error << " % at t = " << time << " s";
    why << "its fastest particles move at " << value("max_water_speed") << " m/s and its sound at "
        << model_.sound_speed << " m/s; waves would come out wrong";
    then << "frames up to there are in " << partial_path(options_.output)
         << "; set water.sound_speed to ten times the fastest flow that is real";
    throw WorkError(what.str(), why.str(), then.str());
  }

  double momentum_residual() {
    const InternalForces f = simulation_->internal_forces();
    return f.sum > 0 ? std::hypot(f.net[0], f.net[1], f.net[2]) / f.sum : 0;
  }

  /// Of the particles that are still there, all phases counted.
  double neighbours_per_particle() const {
    ParticleState s;
    simulation_->download(s);
    std::vector<double> xyz;
    const auto append = [&xyz](const std::vector<double>& x, const std::vector<unsigned char>& lost) {
      for (std::size_t i = 0; i < lost.size(); ++i)
        if (!lost[i]) xyz.insert(xyz.end(), x.begin() + long(3 * i), x.begin() + long(3 * i + 3));
    };
    append(s.water_x, s.water_lost), append(s.soil_x, s.soil_lost);
    const std::size_t moving = xyz.size() / 3;
    xyz.insert(xyz.end(), data_.wall.points.begin(), data_.wall.points.end());
    std::vector<double> body_x;
    std::vector<unsigned> wall_id;
    simulation_->download_bodies(body_x, wall_id);
    for (std::size_t i = 0; i < wall_id.size(); ++i)
      std::copy_n(body_x.begin() + long(3 * i), 3, xyz.begin() + long(3 * (moving + wall_id[i])));
    return mean_neighbours(xyz, moving, 2 * model_.h);
  }

  void accumulate(const ColumnSurfaces& s, double time, bool water, bool soil) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto raise = [&](const std::string& name, const std::vector<float>& values) {
      auto& to = maxima_[name];
      if (to.empty()) to.assign(map_.size(), nan);
      for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i]) && !(to[i] >= values[i])) to[i] = values[i];
    };
    if (water) {
      if (initial_elevation_.empty()) initial_elevation_ = s.water;
      raise("elevation", s.water), raise("depth", s.depth), raise("speed", s.speed);
      auto& arrival = maxima_["arrival"];
      if (arrival.empty()) arrival.assign(map_.size(), nan);
      for (std::size_t i = 0; i < arrival.size(); ++i) {
        if (std::isfinite(arrival[i]) || !std::isfinite(s.water[i])) continue;
        const bool was_dry = !std::isfinite(initial_elevation_[i]);
        if ((was_dry && s.depth[i] > arrival_threshold_) ||
            std::fabs(s.water[i] - initial_elevation_[i]) > arrival_threshold_)
          arrival[i] = float(time);
      }
    }
    if (soil) raise("soil_speed", s.soil_speed);
  }

  /// What has been recorded can be read from here on, whatever comes.
  void flush() {
    writer_->write_maxima(maxima_);
    writer_->flush();
  }

  void checkpoint() {
    wait_for_output();
    flush();
    output_ = {};  // room for the checkpoint
    write_checkpoint(checkpoint_path(options_.output), present());
  }

  Checkpoint present() {
    Checkpoint c;
    c.identity = identity_;
    c.outputs = outputs_, c.frames = writer_->frames(), c.surfaces = writer_->surfaces(),
    c.diagnostics = writer_->diagnostics();
    c.wall_time = elapsed();
    c.extremes = extremes_;
    c.extremes["stepping_time"] = stepping_earlier_ + seconds_taken_;
    c.extremes["retake_failures"] = retaken_.failures, c.extremes["retake_tries"] = retaken_.tries;
    c.extremes["retake_until"] = retaken_.until;
    c.maxima = maxima_, c.initial_elevation = initial_elevation_;
    c.retakes = retakes_;
    c.arrays = simulation_->save();
    return c;
  }

  void restore_state(const Checkpoint& c) {
    simulation_->restore(c.arrays);
    outputs_ = c.outputs, extremes_ = c.extremes, maxima_ = c.maxima, initial_elevation_ = c.initial_elevation;
  }

  /// To what was in the run file at `c`.
  void shorten_run_file(const Checkpoint& c) {
    if (writer_) writer_->flush();  // which tells how much is in the file
    writer_.reset();
    writer_ = std::make_unique<RunWriter>(
        RunWriter::reopen(partial_path(options_.output), c.frames, c.surfaces, c.diagnostics));
  }

  void resume() {
    if (!resume_note_.empty()) log(resume_note_);
    remove_leftovers();
    const Checkpoint c = std::move(resumed_);
    restore_state(c);
    shorten_run_file(c);
    retakes_ = c.retakes;
    earlier_ = c.wall_time;
    stepping_earlier_ = extremes_["stepping_time"];
    retaken_ = {int(extremes_["retake_failures"]), int(extremes_["retake_tries"]), extremes_["retake_until"]};
    char line[120];
    const StepState st = simulation_->state();
    std::snprintf(line, sizeof line, "resumed at %s %.4f s, step %lld", st.settling ? "settling time" : "t =", st.time,
                  static_cast<long long>(st.step));
    log(line);
  }

  std::string finish() {
    wait_for_output();
    writer_->write_maxima(maxima_);
    // Of the run itself: what follows looks back at it.
    const double wall_time = elapsed(), peak = peak_memory();
    const StepState st = simulation_->state();
    const ErrorBudget budget = error_budget(model_, header_, extremes_);
    log(text_of(budget));
    warnings_.insert(warnings_.end(), retakes_.begin(), retakes_.end());
    for (const std::string& warning : warnings_of(budget)) {
      log("warning: " + warning);
      warnings_.push_back(warning);
    }
    nlohmann::ordered_json j;
    j["case"] = case_.name;
    j["particles"] = {{"water", header_.counts.water},
                      {"soil", header_.counts.soil},
                      {"wall", header_.counts.wall},
                      {"left_out", header_.counts.wall_left_out}};
    j["steps"] = st.step;
    j["end_time_s"] = st.time;
    j["left_out"] = simulation_->left_out();
    j["mass_error"] = budget.mass_residual;
    j["density_error"] = extremes_["max_density_error"];
    j["lost"] = {{"water", st.lost_water}, {"soil", st.lost_soil}};
    j["below_bed"] = extremes_["last_below_bed"];
    j["max_water_speed_m_s"] = extremes_["max_water_speed"];
    if (header_.counts.soil) j["max_soil_speed_m_s"] = extremes_["max_soil_speed"];
    j["model"] = simulation_->description();
    const PhaseBytes bytes = simulation_->bytes();
    j["bytes"] = bytes.total();
    const auto each = [](int64_t of_phase, uint64_t n) {
      return n ? nlohmann::ordered_json(double(of_phase) / double(n)) : nlohmann::ordered_json();
    };
    const auto& counts = header_.counts;
    j["bytes_per_particle"] = {{"water", each(bytes.water, uint64_t(counts.water))},
                               {"soil", each(bytes.soil, uint64_t(counts.soil))},
                               {"wall", each(bytes.wall, uint64_t(counts.wall))}};
    j["neighbours_per_particle"] = neighbours_per_particle();  // within the support of the kernel
    j["dimension"] = header_.dimension;
    j["particle_spacing_m"] = header_.dp;
    j["h_over_dp"] = case_.numerics.h_over_dp;
    j["kernel"] = model_.cubic_kernel ? "cubic" : "wendland";
    j["scheme"] = case_.numerics.scheme;
    j["precision"] = precision_name(case_.numerics.precision);
    j["integrator"] = model_.verlet ? "verlet" : "leapfrog";
    j["cfl"] = model_.cfl;
    j["failed_steps_retaken"] = retaken_.failures;
    if (header_.counts.water) j["sound_speed_m_s"] = model_.sound_speed;
    j["time_step_s"] = {{"smallest", st.step ? st.smallest_dt : 0.0},
                        {"mean", st.step ? st.time / double(st.step) : 0.0}};
    // The share of the steps that each condition limited.
    for (int limit = 0; limit < 4; ++limit)
      j["time_step_limited_by"][limit_name(limit)] = double(st.limited[limit]) / std::max(1.0, double(st.step));
    j["resolution"] = json_of(resolution_);
    j["error_budget"] = json_of(budget);
    j["warnings"] = warnings_;
    const nlohmann::ordered_json reproducible = j;
    // What differs from run to run: in the file only with provenance.
    j["wall_time_s"] = wall_time;
    j["set_up_time_s"] = set_up_seconds_;
    j["particle_steps_per_s"] =
        (double(st.step) + extremes_["settle_steps"]) * double(header_.counts.total()) / std::max(wall_time, 1e-9);
    const double stepping = stepping_earlier_ + seconds_taken_;
    j["stepping_time_s"] = stepping;
    j["stepping_particle_steps_per_s"] =
        (double(st.step) + extremes_["settle_steps"]) * double(header_.counts.total()) / std::max(stepping, 1e-9);
    j["peak_memory_bytes"] = peak;
    j["device"] = simulation_->device();
    j["threads"] = threads_;
    j["version"] = version_string();
    for (const PhaseTime& t : simulation_->timings()) j["phase_seconds"][t.name] = t.seconds;
    j["phase_seconds"]["diagnostics"] = diagnostics_seconds_;
    writer_->write_summary((options_.provenance ? j : reproducible).dump(1));
    writer_->close();
    writer_.reset();
    const std::string partial = partial_path(options_.output);
    const int descriptor = ::open(partial.c_str(), O_RDONLY | O_CLOEXEC);
    const bool synced = descriptor >= 0 && fsync(descriptor) == 0;
    std::error_code ec(synced ? 0 : errno, std::generic_category());
    if (descriptor >= 0) close(descriptor);
    if (synced && !rename_file(partial, options_.output, options_.overwrite)) ec.assign(errno, std::generic_category());
    if (ec == std::errc::file_exists)
      throw WorkError(options_.output + " was not written", "another program created it meanwhile",
                      "the whole run is in " + partial);
    if (!ec) sync_folder_of(options_.output);  // before the checkpoints go
    if (ec) throw WorkError("cannot name " + options_.output, ec.message(), "the whole run is in " + partial);
    for (const std::string& path : checkpoints()) fs::remove(path, ec);
    return j.dump(1);
  }

  std::vector<std::string> checkpoints() const {
    const std::string path = checkpoint_path(options_.output);
    return {path, previous_checkpoint(path)};
  }

  const Case& case_;
  const ParticleData& data_;
  ParticleHeader header_;
  RunOptions options_;
  ModelParameters model_;
  SurfaceMap map_;
  ColumnSurfaceMap surface_map_;
  OutputSchedule schedule_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<RunWriter> writer_;
  std::vector<float> initial_soil_, initial_elevation_;
  std::map<std::string, std::vector<float>> maxima_;
  std::map<std::string, double> extremes_;
  std::vector<std::string> gauge_names_;             // of the pressure gauges
  std::vector<std::array<double, 3>> gauge_points_;  // local
  std::string identity_, resume_note_;
  Checkpoint resumed_;
  Resolution resolution_;
  std::vector<std::string> warnings_, outside_, retakes_;  // outside_: of the envelope; retakes_: of failed steps
  double arrival_threshold_ = 0, earlier_ = 0, checkpoint_at_ = 0, seconds_taken_ = 0, stepping_earlier_ = 0,
         diagnostics_seconds_ = 0, set_up_seconds_ = 0;
  struct Kept {
    int64_t step;
    Checkpoint state;
  };
  std::vector<Kept> kept_;  // at most two, the newest last
  /// Of the last output, whose memory the next one uses: new from the system it costs page faults.
  struct {
    ParticleState state;
    std::function<void()> bring;  // what is left to do for it
    StepState at;
    double momentum_residual = 0;
    bool with_frame = false;
    Frame frame;
  } output_;
  struct {
    int failures = 0, tries = 0;  // in the whole run; of the failure at hand
    double until = 0;             // s: end of the smaller time step
  } retaken_;
  static constexpr int64_t steps_between_kept = 500;   // a copy costs the time of a few steps on a device
  static constexpr int steps_between_residuals = 500;  // each costs half of one
  static constexpr int most_failures = 10;
  double step_seconds_ = 0, output_seconds_ = 0;  // of the last with all threads, and of the last
  const int threads_ = omp_get_max_threads();
  int64_t outputs_ = 0, batch_ = 1, steps_taken_ = 0;
  Clock::time_point start_ = Clock::now();
  std::future<void> output_being_made_;
};

}  // namespace

std::string partial_path(const std::string& output) {
  const fs::path p(output);
  std::string name(".");
  name.append(p.stem().string()).append(".partial").append(p.extension().string());
  return (p.parent_path() / name).string();
}
std::string checkpoint_path(const std::string& output) { return output + ".checkpoint"; }

std::string plan_json(const Case& c, const ParticleData& data, double particle_steps_per_s) {
  const ModelParameters p = make_model(c, data);
  const auto simulation = make_cpu_simulation(p, make_particles(c, data), number_type(c.numerics.precision));
  double wave = p.sound_speed;
  if (data.soil.size())
    wave = std::max(wave, SoilMaterial<double>::wave_speed(p.young_modulus, p.poisson_ratio, p.soil_density));
  // A tenth of the wave speed is what flow adds to the acoustic condition in a run that keeps its Mach number.
  const double dt = std::min(simulation->state().dt, p.cfl * p.h / (1.1 * wave));
  const double steps = (c.output.end_time + p.settle_time) / dt;
  if (!(particle_steps_per_s > 0))
    particle_steps_per_s = particle_rate(c.dimension, data.soil.size() > 0, omp_get_max_threads());
  const Resolution resolution = resolution_of(c, data);
  nlohmann::ordered_json j;
  j["case"] = c.name;
  j["particles"] = {{"water", data.header.counts.water},
                    {"soil", data.header.counts.soil},
                    {"wall", data.header.counts.wall},
                    {"left_out", data.header.counts.wall_left_out}};
  j["left_out"] = simulation->left_out();
  j["memory_bytes"] = std::llround(
      estimate_run(c, data.header.counts, p.sound_speed, p.soil_height, particle_steps_per_s).memory_bytes);
  j["solver_bytes"] = simulation->bytes().total();
  const OutputSize size = output_size(c, data.header, moving_bytes(*simulation));
  j["disk_bytes_at_most"] = {{"run", size.run}, {"checkpoints", size.checkpoints}};
  j["time_step_s"] = dt;
  j["steps"] = std::llround(steps);
  j["estimated_run_time_s"] = steps * double(data.header.counts.total()) / particle_steps_per_s;
  j["particle_steps_per_s_assumed"] = particle_steps_per_s;
  j["resolution"] = json_of(resolution);
  const std::vector<EnvelopeAxis> envelope = envelope_of(c, p);
  j["warnings"] = warnings_beforehand(resolution, warnings_of(envelope));
  j["envelope"] = json_of(envelope);
  j["expected_error"] = expected_error(resolution.slide_median, resolution.deepest_water).text;
  return j.dump(1);
}

std::string run_case(const Case& c, const ParticleData& data, const RunOptions& options) {
  give_back_large_blocks();
  Runner runner(c, data, options);
  return runner.run();
}

}  // namespace lgiw
