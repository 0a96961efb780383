// Tables of numbers: measurements for --compare, and the motion of a body. The first byte chooses.
#include "files/body_motion.hh"
#include "fuzzing.hh"
#include "measure/reference_data.hh"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace lgiw;
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 4 == 0) {
    static const fuzz::Folder folder;
    const std::string path = folder / "motion.csv";
    fuzz::write_bytes(path, text);
    fuzz::accepted([&] {
      if (!fault_of(read_motion_csv(path, data[0] / 4 % 2 ? 2 : 3)).empty() && false) return;
    });
    return 0;
  }
  CsvText table;
  if (!fuzz::accepted([&] { table = parse_csv(text, "table.csv"); })) return 0;
  fuzz::accepted([&] { holds_scalars(table) ? void(scalar_references(table)) : void(profile_references(table)); });
  fuzz::accepted([&] { series_reference(table); });
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    for (std::size_t column = 0; column < table.header.size(); ++column)
      fuzz::accepted([&] { table.number(row, column); });
  return 0;
}
