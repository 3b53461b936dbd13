// One process works in a run's folder.
#pragma once

#include <filesystem>

namespace nlcwfs {

/// One process works in a run's folder, as long as this lives; the system frees the folder of a
/// process that is killed (that of a machine which dies, where a network's file system does). A
/// file system without locks has none.
class FolderLock {
 public:
  /// @param folder  that has a config.cfg
  /// @throws InputError naming --resume where another run works in it
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

}  // namespace nlcwfs
