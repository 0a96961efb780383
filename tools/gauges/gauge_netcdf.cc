#include "gauge_netcdf.hh"

#include <netcdf.h>

#include <algorithm>

#include "base/atomic_file.hh"
#include "base/error.hh"

namespace lgiw {
namespace {

/// An open netCDF file; every failure is a WorkError that names the file.
class NetCdf {
 public:
  explicit NetCdf(const AtomicFile& file) : path_(file.path()) {
    // The classic format: it holds no dates, so that reruns are byte-identical, and every reader knows it.
    check(nc_create(file.temporary().c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &id_));
  }
  ~NetCdf() {
    if (id_ >= 0) nc_abort(id_);
  }
  NetCdf(const NetCdf&) = delete;
  NetCdf& operator=(const NetCdf&) = delete;

  int dimension(const char* name, std::size_t length) {
    int dimension = 0;
    check(nc_def_dim(id_, name, length, &dimension));
    return dimension;
  }
  int variable(const char* name, nc_type type, const std::vector<int>& dimensions,
               const std::vector<std::pair<const char*, std::string>>& attributes) {
    int variable = 0;
    check(nc_def_var(id_, name, type, int(dimensions.size()), dimensions.data(), &variable));
    for (const auto& [key, text] : attributes) attribute(variable, key, text);
    if (type == NC_DOUBLE && dimensions.size() > 1) {
      const double fill = NC_FILL_DOUBLE;
      check(nc_put_att_double(id_, variable, "_FillValue", NC_DOUBLE, 1, &fill));
    }
    return variable;
  }
  void attribute(int variable, const char* name, const std::string& text) {
    check(nc_put_att_text(id_, variable, name, text.size(), text.data()));
  }
  void attribute(int variable, const char* name, const std::vector<int>& values) {
    check(nc_put_att_int(id_, variable, name, NC_INT, values.size(), values.data()));
  }
  void end_definitions() { check(nc_enddef(id_)); }
  void put(int variable, const std::vector<double>& values) { check(nc_put_var_double(id_, variable, values.data())); }
  void put(int variable, const std::string& values) { check(nc_put_var_text(id_, variable, values.data())); }
  void close() {
    const int status = nc_close(id_);
    id_ = -1;
    check(status);
  }

 private:
  void check(int status) const {
    if (status != NC_NOERR)
      throw WorkError("cannot write '" + path_ + "'", nc_strerror(status), "check the disk and the folder");
  }
  std::string path_;
  int id_ = -1;
};

}  // namespace

void write_gauge_netcdf(const std::string& path, const ParticleHeader& header, const std::vector<GaugeSeries>& series,
                        const std::string& case_name, const std::string& provenance, bool overwrite) {
  LGIW_VALIDATE(!series.empty(), "there is no gauge to write to '" + path + "'", "a time series has a station",
                "add gauges to the case or pass --gauge name,x,y");
  AtomicFile file(path, overwrite);
  NetCdf nc(file);
  const std::size_t times = series.front().time.size(), stations = series.size();
  std::size_t name_length = 1;
  for (const GaugeSeries& s : series) name_length = std::max(name_length, s.gauge.name.size());

  const int station = nc.dimension("station", stations);
  const int time = nc.dimension("time", times);
  const int length = nc.dimension("name_length", name_length);
  const std::string datum = header.vertical_datum.empty() ? "the case's vertical datum" : header.vertical_datum;
  const int time_of = nc.variable("time", NC_DOUBLE, {time},
                                  {{"standard_name", "time"},
                                   {"long_name", "time since the start of the run"},
                                   {"units", "seconds since 2000-01-01 00:00:00"},
                                   {"comment", "model time: the date is arbitrary"},
                                   {"axis", "T"}});
  const int name_of =
      nc.variable("station_name", NC_CHAR, {station, length}, {{"long_name", "gauge"}, {"cf_role", "timeseries_id"}});
  const int x_of =
      nc.variable("x", NC_DOUBLE, {station}, {{"standard_name", "projection_x_coordinate"}, {"units", "m"}});
  const int y_of =
      nc.variable("y", NC_DOUBLE, {station}, {{"standard_name", "projection_y_coordinate"}, {"units", "m"}});
  const int bed_of =
      nc.variable("bed", NC_DOUBLE, {station}, {{"long_name", "elevation of the bed above " + datum}, {"units", "m"}});
  const int surface_of = nc.variable("surface_kind", NC_INT, {station},
                                     {{"long_name", "what the gauge follows"}, {"flag_meanings", "water soil"}});
  nc.attribute(surface_of, "flag_values", std::vector<int>{0, 1});
  std::vector<std::pair<const char*, std::string>> elevation{
      {"long_name", "elevation of the water surface (on soil: of the soil surface) above " + datum},
      {"units", "m"},
      {"coordinates", "x y station_name"}};
  std::vector<std::pair<const char*, std::string>> height{
      {"long_name", "height above still water level (on soil: above its surface at the start)"},
      {"units", "m"},
      {"coordinates", "x y station_name"}};
  if (!header.crs_wkt.empty()) {
    nc.variable("crs", NC_INT, {}, {{"crs_wkt", header.crs_wkt}});
    elevation.push_back({"grid_mapping", "crs"});
    height.push_back({"grid_mapping", "crs"});
  }
  const int elevation_of = nc.variable("surface_elevation", NC_DOUBLE, {station, time}, elevation);
  const int height_of = nc.variable("surface_height", NC_DOUBLE, {station, time}, height);
  nc.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  nc.attribute(NC_GLOBAL, "featureType", "timeSeries");
  nc.attribute(NC_GLOBAL, "title", "Wave gauges of case " + case_name);
  nc.attribute(NC_GLOBAL, "vertical_datum", header.vertical_datum);
  if (!provenance.empty()) nc.attribute(NC_GLOBAL, "provenance", provenance);
  nc.end_definitions();

  std::string names(stations * name_length, '\0');
  std::vector<double> x, y, bed, kind, elevations, heights;
  const auto filled = [](double value) { return value == value ? value : NC_FILL_DOUBLE; };
  for (std::size_t s = 0; s < stations; ++s) {
    const GaugeSeries& gauge = series[s];
    std::copy(gauge.gauge.name.begin(), gauge.gauge.name.end(), names.begin() + std::ptrdiff_t(s * name_length));
    x.push_back(gauge.gauge.x), y.push_back(gauge.gauge.y), bed.push_back(gauge.bed);
    kind.push_back(gauge.surface == GaugeSurface::soil ? 1 : 0);
    for (double z : gauge.elevation) {
      elevations.push_back(filled(z));
      heights.push_back(filled(z - gauge.reference));
    }
  }
  nc.put(time_of, series.front().time);
  nc.put(name_of, names);
  nc.put(x_of, x), nc.put(y_of, y), nc.put(bed_of, bed), nc.put(surface_of, kind);
  nc.put(elevation_of, elevations);
  nc.put(height_of, heights);
  nc.close();
  file.commit();
}

}  // namespace lgiw
