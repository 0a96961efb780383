// An HDF5 file whose metadata change all at once: a process that is killed, or a disk that is full, at any moment leaves the
// file of the last flush, or of the one under way, never something between.
//
// HDF5 writes its metadata (headers, B-trees, superblock) over those of the flush before, piece by piece. Here they gather
// in memory; a flush writes them to a journal beside the file, then over the old ones, then removes the journal. Raw data
// go straight to the file: to new places, which no metadata on the disk refer to yet. The caller may overwrite raw data in
// place only where old and new serve alike.
#pragma once

#include <hdf5.h>

#include <memory>
#include <string>

namespace lgiw::h5 {

/// Shared by a file and its driver.
struct Journal {
  std::string path;
  /// Only an armed flush reaches the disk: that of a file which is closed after an error must not.
  bool armed = false;
};

/// "FOLDER/.NAME.journal" of the file FOLDER/NAME (or FOLDER/.NAME).
std::string journal_path(const std::string& file);

/// Makes `access` (a file access property list) use the driver, with a file that exclusively this process writes.
void set_journaled_driver(hid_t access, const std::shared_ptr<Journal>& journal);

/// Brings a file to its last flush: carries out a journal that is whole, and removes one that is not. Throws WorkError
/// when the disk fails.
void carry_out_journal(const std::string& file);

/// Whether a journaled file of that name is being written, by any process.
bool is_being_written(const std::string& file);

}  // namespace lgiw::h5
