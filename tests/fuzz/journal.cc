// The journal of a file: the first byte says how much of the input is the file, and whether the digest is right.
#include "base/provenance.hh"
#include "files/journaled_driver.hh"
#include "fuzzing.hh"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace lgiw;
  static const fuzz::Folder folder;
  const std::string path = folder / "file";
  fuzz::Script script(data, size);
  const uint8_t how = script.byte();
  fuzz::write_bytes(path, std::string(how / 2, 'x'));
  std::string text = script.rest();
  // Sizes of terabytes would be those of a file with holes; here they only take time.
  if (text.size() > 23)
    for (std::size_t k = 18; k < 23; ++k) text[k] = 0;
  if (how % 2) text += sha256_of_text(text);
  fuzz::write_bytes(h5::journal_path(path), text);
  fuzz::accepted([&] { h5::carry_out_journal(path); });
  std::filesystem::remove(h5::journal_path(path));
  return 0;
}
