#include "files/body_motion.hh"

#include <numbers>

#include "support.hh"

namespace lgiw {
namespace {

/// The motion in a file with this text, or what is wrong with it.
BodyMotion motion_of(const std::string& text, int dimension = 3) {
  const Scratch scratch;
  write_bytes(scratch / "m.csv", text);
  return read_motion_csv(scratch / "m.csv", dimension);
}

std::string refusal_of(const std::string& text, int dimension = 3) {
  const Scratch scratch;
  const std::string path = scratch / "m.csv";
  write_bytes(path, text);
  return error_of<InputError>(path, [&] { read_motion_csv(path, dimension); });
}

TEST(BodyMotion, ReadsTheFourForms) {
  const BodyMotion plain = motion_of("# measured\nt_s,dx_m,dz_m\n0,0,0\n\n0.5, 1e-1 ,-0.2\r\n # end\n");
  EXPECT_EQ(plain.time, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(plain.displacement, (std::vector<std::array<double, 3>>{{0, 0, 0}, {0.1, 0, -0.2}}));
  EXPECT_EQ(plain.pitch, (std::vector<double>{0, 0}));
  EXPECT_EQ(plain.heading, 90);
  const BodyMotion pitching = motion_of("t_s,dx_m,dz_m,pitch_deg\n-1,-1,1,-90\n+1,+1,-1,90", 2);
  EXPECT_DOUBLE_EQ(pitching.pitch[1], std::numbers::pi / 2);
  const BodyMotion three = motion_of("t_s,dx_m,dy_m,dz_m\n0,0,0,0\n1,2,3,4\n");
  EXPECT_EQ(three.displacement[1], (std::array<double, 3>{2, 3, 4}));
  EXPECT_EQ(motion_of("t_s,dx_m,dy_m,dz_m,pitch_deg\n0,0,0,0,0\n1,2,3,4,180\n").pitch[1], std::numbers::pi);
  EXPECT_EQ(motion_of("t_s,dx_m,dy_m,dz_m\n0,0,0,0\n1,2,0,4\n", 2).time.size(), 2u);
}

TEST(BodyMotion, RefusesWithTheLine) {
  EXPECT_EQ(refusal_of("0,0,0\n1,1,1\n"),
            "FILE:1: there is no header (the first line names the columns) write one above the numbers");
  EXPECT_EQ(refusal_of("t_s,dx_m,pitch_deg\n0,0,0\n"),
            "FILE:1: not the header of a motion (the columns are told by their names) write "
            "t_s,dx_m,dz_m[,pitch_deg] or t_s,dx_m,dy_m,dz_m[,pitch_deg]");
  const std::string head = "# c\nt_s,dx_m,dz_m\n";
  EXPECT_EQ(refusal_of(head + "0,0\n"),
            "FILE:3: 2 cells instead of 3 (every row has as many as the header) separate them with commas and leave "
            "unknown ones empty");
  for (const char* bad : {"x", "inf", "1e999", "1;2", "0x10", "+-1", "1 m"})
    EXPECT_EQ(
        refusal_of(head + "0,0,0\n1,0," + bad + "\n"),
        "FILE:4: '" + std::string(bad) + "' is no number (column dz_m holds numbers) write it with a decimal point");
  for (const char* none : {"", "nan"})
    EXPECT_EQ(refusal_of(head + "0,0,0\n1,0," + none + "\n"),
              "FILE:4: dz_m is missing (every row needs it) give it, or leave out the row");
  EXPECT_EQ(refusal_of(head + "0.1,0,0\n"),
            "FILE:3: the first time is 0.1 s (the motion must be known from t = 0 on) begin with a row at t_s = 0 or "
            "before");
  EXPECT_EQ(refusal_of(head + "0,0,0\n1,0,0\n1,0,0\n"),
            "FILE:5: the time 1 s does not rise (a body is at one place at a time) sort the rows by t_s");
  EXPECT_EQ(refusal_of(head), "FILE has no rows (there is only a header) see that the name is right");
  EXPECT_EQ(refusal_of(head + "-1,0,0\n1,2,0\n"),
            "FILE: at t = 0 dx_m is 1.000000 (displacement and pitch count from where the case has the body at t = 0) "
            "subtract it from all rows");
  EXPECT_EQ(refusal_of("t_s,dx_m,dy_m,dz_m\n0,0,0,0\n1,0,2,0\n", 2),
            "FILE:3: dy_m is 2 (a 2-D scene lies in (x, z)) leave the column dy_m out");
  EXPECT_EQ(error_of<InputError>("/no/such.csv", [] { read_motion_csv("/no/such.csv", 3); }),
            "FILE cannot be read (there is no such file, or no right to it) see that the name is right");
  const Scratch folder;
  EXPECT_EQ(error_of<InputError>(folder / "", [&] { read_motion_csv(folder / "", 3); }),
            "FILE is a folder (a file with a table is wanted) name the file in it");
}

}  // namespace
}  // namespace lgiw
