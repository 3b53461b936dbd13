// Tests: One process works in a run's folder.
#include "results/archive/folder_lock.hpp"

#include "tests/message_of.hpp"
#include "tests/scratch_folder.hpp"

#include <cstdlib>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using FolderLockTest = ScratchFolder;

TEST_F(FolderLockTest, IsOneRunsAlone) {
  std::ofstream("config.cfg") << "";
  {
    const FolderLock lock(".");
    EXPECT_EQ(message_of([] { const FolderLock other("."); }),
              "--resume = .: another run works in it; wait for its end, or end it first");
    std::ifstream("config.cfg").get();
    EXPECT_NE(message_of([] { const FolderLock other("."); }), "") << "read meanwhile";
  }
  EXPECT_EQ(message_of([] { const FolderLock other("."); }), "");
}

TEST_F(FolderLockTest, IsNotOfProgramsThatTheRunHasStarted) {
  std::ofstream("config.cfg") << "";
  {
    const FolderLock lock(".");
    ASSERT_EQ(std::system("sleep 60 > /dev/null & echo $! > pid"), 0);
  }
  EXPECT_EQ(message_of([] { const FolderLock other("."); }), "");
  EXPECT_EQ(std::system("kill $(cat pid)"), 0);
}

TEST_F(FolderLockTest, IsNoneWhereThereIsNothingToLock) {
  const FolderLock lock(".");
  EXPECT_EQ(message_of([] { const FolderLock other("."); }), "");
}

}  // namespace
}  // namespace nlcwfs
