// What the scripts of figures take out of the tables, as gnuplot gets it.
#include "tool_runner.hh"

namespace lgiw::test {
namespace {

/// Numbers and names that a function of ground.gp makes of profiles.csv.
std::string points_of_profiles(const Workshop& shop, const std::string& function) {
  const std::string command = "{ gnuplot -e \"work='.'; set loadpath '" LGIW_SOURCE_DIR
                              "/pipelines/figures'; load 'common.gp'; load 'ground.gp'; print " +
                              function + "('profiles.csv')\" 2>&1 | sed 's/^< //' | sh; }";
  return shop.run(command).out;
}

TEST(Figures, SectionsAreLinesApartHoweverManyTimesTheProfilesHave) {
  const Workshop shop;
  write_bytes(shop / "ground.xyz", "0 0 5\n10 0 5\n\n0 10 5\n10 10 5\n");
  std::string profiles = "# provenance: {}\nsection,time_s,distance_m,x,y,ground_m,bed_m,soil_m,water_m,slip_m\n";
  for (const char* time : {"0", "7.5", "15"})
    for (const char* row : {"A,%,0,1,1", "A,%,5,4,5", "A,%,10,9,5", "B,%,0,2,8", "B,%,6,8,8"}) {
      std::string text(row);
      profiles += text.replace(text.find('%'), 1, time) + ",5,5,nan,nan,nan\n";
    }
  write_bytes(shop / "profiles.csv", profiles);
  EXPECT_EQ(points_of_profiles(shop, "section_lines"), "1 1\n4 5\n9 5\n\n2 8\n8 8\n");
  EXPECT_EQ(points_of_profiles(shop, "section_ends"), "1 1 A\n9 5 A'\n2 8 B\n8 8 B'\n");
}

}  // namespace
}  // namespace lgiw::test
