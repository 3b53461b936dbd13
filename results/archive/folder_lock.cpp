// One process works in a run's folder.
#include "results/archive/folder_lock.hpp"

#include "model/input_error.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace nlcwfs {

// Of the configuration, as a network's file system locks no folder, and SQLite would lose its own
// lock where the archive is closed once more. Not of processes that this one starts.
FolderLock::FolderLock(const std::filesystem::path& folder)
    : file_(open((folder / "config.cfg").c_str(), O_RDWR | O_CLOEXEC)) {
  // One that is made read-only can be locked where it is no network's.
  if (file_ < 0) file_ = open((folder / "config.cfg").c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(file_);
  throw InputError("--resume", folder.string(), "another run works in it",
                   "wait for its end, or end it first");
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace nlcwfs
